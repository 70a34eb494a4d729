#include "viewer/recording.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "record/truth.h"

namespace understudy::viewer {
namespace {

constexpr char kModelName[] = "model.mjb";
constexpr std::uint64_t kSecond = 1'000'000'000;  // ns
constexpr double kRounding = 1e-6;                // s between what is asked for and what is there
constexpr double kLookBack = 1;                   // s in which there is a state for sure
constexpr double kLongest = 1e9;                  // s; what says more is damaged

record::Truth Decode(const record::McapMessage& message) {
  record::Truth truth = record::DecodeTruth(message.data);
  if (truth.time >= 0 && truth.time <= kLongest) return truth;
  throw RecordError("a state of second " + std::to_string(truth.time));
}

}  // namespace

Recording::Recording(const std::filesystem::path& file) : reader_(file) {
  bool found = false;
  reader_.ReadMessages([&](const record::McapChannel& channel, const record::McapMessage& message) {
    if (channel.topic != record::kTruthTopic) return true;
    whole_.from = Decode(message).time;
    origin_ = message.log_time - static_cast<std::uint64_t>(whole_.from * kSecond);
    found = true;
    return false;
  });
  if (!found) {
    throw RecordError(file.string() + ": no messages on " + record::kTruthTopic +
                      ", which `understudy run --record` writes");
  }
  whole_.to = whole_.from;
  const std::uint64_t end = reader_.contents().last_time;
  reader_.ReadMessages(end - std::min(end, static_cast<std::uint64_t>(kLookBack * kSecond)), end,
                       [&](const record::McapChannel& channel, const record::McapMessage& message) {
                         if (channel.topic == record::kTruthTopic) {
                           whole_.to = std::max(whole_.to, Decode(message).time);
                         }
                         return true;
                       });
}

mjcf::ModelHandle Recording::ReadModel() const {
  const std::vector<std::byte> bytes = reader_.ReadAttachment(kModelName);
  return mjcf::ReadBinaryModel({reinterpret_cast<const char*>(bytes.data()), bytes.size()},
                               reader_.path().string() + ", " + kModelName);
}

void Recording::Refuse(double time) const {
  throw SetupError(reader_.path().string() + ": it has no second " + std::to_string(time) +
                   "; it goes from " + std::to_string(whole_.from) + " to " +
                   std::to_string(whole_.to));
}

Recording::Span Recording::Cut(std::optional<double> from, std::optional<double> to) const {
  const Span span{.from = std::max(from.value_or(whole_.from), whole_.from),
                  .to = std::min(to.value_or(whole_.to), whole_.to)};
  if (span.from < span.to) return span;
  if (from && to && *from >= *to) {
    throw SetupError("--from " + std::to_string(*from) + " is not before --to " +
                     std::to_string(*to));
  }
  Refuse(from && *from >= whole_.to ? *from : to.value_or(whole_.to));
}

std::uint64_t Recording::LogTime(double time) const {
  return origin_ + static_cast<std::uint64_t>(std::llround(std::max(time, 0.0) * kSecond));
}

SceneState Recording::At(std::optional<double> time, std::size_t nq) const {
  const double at = std::max(time.value_or(whole_.to), whole_.from);
  if (at > whole_.to + kRounding) Refuse(at);
  SceneState last;
  Read({.from = at - kLookBack, .to = at + kRounding}, nq, [&](const SceneState& state) {
    last = state;
    return true;
  });
  if (last.qpos.empty()) Refuse(at);
  return last;
}

void Recording::Read(const Span& span, std::size_t nq, const Visit& visit, const Tell& tell,
                     double before) const {
  const std::uint64_t from = LogTime(span.from);
  reader_.ReadMessages(LogTime(span.from - before), LogTime(span.to),
                       [&](const record::McapChannel& channel, const record::McapMessage& message) {
                         if (tell && channel.topic == record::kEventTopic) {
                           record::Event event = record::DecodeEvent(message.data);
                           if (record::IsForPictures(event.kind)) {
                             tell({.time = event.time, .text = std::move(event.text)});
                           }
                         }
                         if (channel.topic != record::kTruthTopic || message.log_time < from)
                           return true;
                         record::Truth truth = Decode(message);
                         if (truth.qpos.size() != nq) {
                           throw RecordError("a state of " + std::to_string(truth.qpos.size()) +
                                             " positions, its model has " + std::to_string(nq));
                         }
                         SceneState state;
                         state.step = truth.step;
                         state.time = truth.time;
                         state.qpos = std::move(truth.qpos);
                         return visit(state);
                       });
}

}  // namespace understudy::viewer
