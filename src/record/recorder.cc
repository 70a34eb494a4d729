#include "record/recorder.h"

#include <algorithm>
#include <limits>
#include <string_view>

#include "bus/now.h"
#include "idl/type_table.h"
#include "version.h"

namespace understudy::record {
namespace {

using std::chrono::milliseconds;

// Period of the thread; longest wait of a message for its tick, which does not come in a pause;
// longest time that a message is only in memory. All *assumed*.
constexpr milliseconds kPollEvery(5);
constexpr std::int64_t kPatience = 200'000'000;      // ns
constexpr std::int64_t kFlushEvery = 1'000'000'000;  // ns

// Room for 8 s of moments at 1000 Hz and as many marks; *assumed*.
constexpr std::size_t kMoments = 8192;
constexpr std::size_t kMarks = 1 << 16;
constexpr std::size_t kSheets = 4;  // *assumed*
// Topics that are looked at; *assumed*, several times those of a robot and its programs.
constexpr std::size_t kMostTopics = 512;
// Topics of other types that are named; *assumed*, more than a program's own.
constexpr std::size_t kMostNamed = 8;
// Frames are drawn and encoded where somebody reads them, which costs more than all else: they
// would be for the recording alone.
constexpr std::string_view kVideo = "unitree_go::msg::dds_::Go2FrontVideoData_";

std::int64_t Monotonic() { return std::chrono::steady_clock::now().time_since_epoch().count(); }
std::int64_t SinceEpoch() { return bus::Now().count(); }

}  // namespace

Recorder::Recorder(const bus::Participant& participant, OutputFile file, const RecordingHead& head,
                   const emulator::EventRing* events, const Moment& moment,
                   std::chrono::nanoseconds timestep, std::int64_t first_step, Say say,
                   Audience* audience)
    : participant_(participant),
      ours_(participant.key()),
      watch_(participant),
      timestep_(timestep.count()),
      start_(head.start.value_or(
          static_cast<std::uint64_t>(SinceEpoch() - first_step * timestep.count()))),
      say_(std::move(say)),
      audience_(audience),
      writer_(std::move(file), "ros2", std::string("understudy ") + kVersion),
      ros_(head.ros),
      events_of_(head.events_of),
      events_(events),
      moments_(kMoments, moment),
      sheets_(kSheets, {.damage = head.damage}),
      marks_(kMarks),
      last_take_(SinceEpoch()),
      last_flush_(Monotonic()),
      marked_(first_step - 1) {
  while (!has_event_ && events_.Next(&event_)) has_event_ = event_.step >= first_step;
  Begin(head);
  Subscribe();
  thread_ = std::jthread([this](const std::stop_token& stop) { Run(stop); });
}

Recorder::~Recorder() {
  thread_.request_stop();
  wake_.notify_all();
  thread_.join();
}

void Recorder::Mark(std::int64_t step) {
  if (failed_.load(std::memory_order_relaxed)) return;
  StepMark* mark = marks_.Claim();
  if (mark == nullptr) return;
  *mark = {.wall = Monotonic(), .epoch = SinceEpoch(), .step = step};
  marks_.Commit();
}

Moment* Recorder::Claim() {
  if (failed_.load(std::memory_order_relaxed)) return nullptr;
  Moment* moment = moments_.Claim();
  if (moment != nullptr) moment->wall = Monotonic();
  return moment;
}

void Recorder::Commit() { moments_.Commit(); }

DamageMoment* Recorder::ClaimDamage() {
  if (failed_.load(std::memory_order_relaxed)) return nullptr;
  DamageMoment* moment = sheets_.Claim();
  if (moment != nullptr) moment->wall = Monotonic();
  return moment;
}

void Recorder::CommitDamage() { sheets_.Commit(); }

bool Recorder::behind() const {
  return !failed_.load(std::memory_order_relaxed) &&
         (moments_.size() > kMoments / 2 || marks_.size() > kMarks / 2 ||
          sheets_.size() > kSheets / 2);
}

void Recorder::CatchUp() {
  std::uint64_t asked = 0;
  {
    const std::lock_guard lock(mutex_);
    asked = ++asked_;
  }
  wake_.notify_all();
  for (std::uint64_t answered = answered_; answered < asked; answered = answered_) {
    answered_.wait(answered);
  }
}

emulator::RecordingStatus Recorder::status() const {
  return {.state = failed_ ? emulator::RecordingState::kFailed : emulator::RecordingState::kOn,
          .messages = messages_,
          .bytes = bytes_,
          .dropped = moments_.dropped() + marks_.dropped()};
}

void Recorder::Run(const std::stop_token& stop) {
  try {
    while (!stop.stop_requested()) {
      Poll();
      std::unique_lock lock(mutex_);
      wake_.wait_for(lock, stop, kPollEvery, [this] { return asked_ != answered_; });
    }
    Take();
    Merge(std::numeric_limits<Nanoseconds>::max(), true);
    WriteHeldBack(digest_.Flush(), marked_ + 1);
    writer_.Finish();
    messages_ = writer_.messages();
    bytes_ = writer_.bytes();
  } catch (const std::exception& error) {
    failed_ = true;
    answered_ = std::numeric_limits<std::uint64_t>::max();
    answered_.notify_all();
    waiting_.clear();
    topics_.clear();
    say_(std::string(error.what()) + ": recording has stopped; the robot continues", true);
  }
}

void Recorder::Poll() {
  const std::uint64_t asked = asked_;
  Subscribe();
  const Nanoseconds now = Monotonic();
  Take();
  Merge(now, false);
  if (now - last_flush_ > kFlushEvery) {
    writer_.Flush();
    last_flush_ = now;
  }
  messages_ = writer_.messages();
  bytes_ = writer_.bytes();
  answered_ = asked;
  answered_.notify_all();
  const std::uint64_t dropped = moments_.dropped() + marks_.dropped();
  if (dropped != told_dropped_) {
    say_("the recording is behind: " + std::to_string(dropped - told_dropped_) +
             " moments of the simulation are not in it",
         true);
    told_dropped_ = dropped;
  }
}

void Recorder::Subscribe() {
  for (bus::TopicOnBus& found : watch_.Poll()) {
    if (seen_.size() == kMostTopics || !seen_.insert(found).second) continue;
    if (seen_.size() == kMostTopics)
      say_("no further topics are recorded: there are too many", true);
    if (found.type == kVideo) continue;
    const MessageType* type = FindMessageType(found.type);
    if (type == nullptr && ++unknown_ > kMostNamed) {
      if (unknown_ == kMostNamed + 1) {
        say_("further topics whose types are none of the vendor's are not recorded", false);
      }
      continue;
    }
    if (type == nullptr) {
      say_("topic " + found.topic + " is not recorded: its type " + found.type +
               " is none of the vendor's",
           false);
      continue;
    }
    auto reader = std::make_unique<bus::CdrReader>(participant_, found.topic, *type->descriptor);
    topics_.push_back({.name = std::move(found), .reader = std::move(reader)});
  }
}

// Clamps source times of other participants to the time since the last take began: one outside
// comes from another clock. Our messages have the clock of the marks. What another sends at the
// instant of a mark answers that step, and comes after it: where time stands still in a step, that
// is usual.
void Recorder::Take() {
  const Nanoseconds since = std::exchange(last_take_, SinceEpoch());
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    Topic& topic = topics_[i];
    topic.reader->Take([&](bus::CdrSample sample) {
      const auto [writer, is_new] = topic.ours.try_emplace(sample.writer(), false);
      if (is_new) writer->second = topic.reader->ParticipantOf(sample.writer()) == ours_;
      const Nanoseconds now = SinceEpoch();
      const Nanoseconds when =
          writer->second ? sample.source_time()
                         : std::clamp(sample.source_time(), std::min(since, now), now) + 1;
      waiting_.push_back({.when = when,
                          .taken = Monotonic(),
                          .topic = i,
                          .ours = writer->second,
                          .sample = std::move(sample)});
    });
  }
}

// A message belongs to the first step that was marked at its time or later: in this step it was
// sent or could be taken. Leaves marks after `now`, because some of their messages may not be taken
// yet.
void Recorder::Merge(Nanoseconds now, bool all) {
  std::ranges::stable_sort(waiting_, {}, &Waiting::when);
  auto next = waiting_.begin();
  for (const StepMark* mark = marks_.Front(); mark != nullptr && mark->wall <= now;
       mark = marks_.Front()) {
    WriteMoments(mark->step, now);
    WriteSheets(mark->step, now);
    WriteEvents(mark->step);
    for (; next != waiting_.end() && next->when <= mark->epoch; ++next) {
      WriteSample(*next, mark->step);
    }
    marked_ = mark->step;
    marks_.Pop();
  }
  WriteMoments(std::numeric_limits<std::int64_t>::max(), now);
  WriteSheets(std::numeric_limits<std::int64_t>::max(), now);
  WriteEvents(marked_ + 1);
  for (; next != waiting_.end() && (all || now - next->taken > kPatience); ++next) {
    WriteSample(*next, marked_ + 1);
  }
  waiting_.erase(waiting_.begin(), next);
}

void Recorder::WriteMoments(std::int64_t up_to_step, Nanoseconds up_to) {
  for (const Moment* moment = moments_.Front();
       moment != nullptr && moment->truth.step <= up_to_step && moment->wall <= up_to;
       moment = moments_.Front()) {
    WriteTruth(moment->truth);
    moments_.Pop();
  }
}

void Recorder::WriteSheets(std::int64_t up_to_step, Nanoseconds up_to) {
  for (const DamageMoment* moment = sheets_.Front();
       moment != nullptr && moment->damage.step <= up_to_step && moment->wall <= up_to;
       moment = sheets_.Front()) {
    EncodeDamage(moment->damage, &message_);
    Write(damage_channel_, LogTime(moment->damage.step), LogTime(moment->damage.step),
          message_.span());
    sheets_.Pop();
  }
}

void Recorder::WriteEvents(std::int64_t up_to_step) {
  while (has_event_ || events_.Next(&event_)) {
    has_event_ = event_.step > up_to_step;
    if (has_event_) break;
    if (event_.robot != events_of_ && !emulator::RowOf(event_.kind).of_world) continue;
    if (const auto told = digest_.Take(event_, event_.time)) WriteEvent(*told);
  }
  WriteHeldBack(digest_.Due(TimeOf(up_to_step)), up_to_step);
}

// An event that was held back gets the step in which it is reported, to keep the order of time.
void Recorder::WriteHeldBack(const std::vector<emulator::ToldEvent>& held, std::int64_t step) {
  for (emulator::ToldEvent told : held) {
    told.event.step = step;
    told.event.time = TimeOf(step);
    WriteEvent(told);
  }
}

double Recorder::TimeOf(std::int64_t step) const {
  return 1e-9 * static_cast<double>(step * timestep_);
}

std::uint64_t Recorder::LogTime(std::int64_t step) const {
  return start_ + static_cast<std::uint64_t>(step * timestep_);
}

}  // namespace understudy::record
