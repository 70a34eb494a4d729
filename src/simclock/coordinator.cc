#include "simclock/coordinator.h"

#include <algorithm>
#include <climits>
#include <csignal>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <set>
#include <system_error>
#include <vector>

#include <dlfcn.h>
#include <linux/futex.h>
#include <sched.h>
#include <spdlog/spdlog.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "simclock/cores.h"

namespace understudy::simclock {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Wall = time::Clock::Time;

// All *assumed*.
constexpr seconds kProgramBegins(10);   // until a program has taken the clock
constexpr microseconds kPatience(200);  // for a thread that sleeps and does not say why
constexpr microseconds kGlance(50);     // between looks, with priority over what it looks at
constexpr seconds kMostSleeping(60);    // until a thread that sleeps in the kernel goes on
constexpr milliseconds kStalledStep(1);
constexpr seconds kLookEvery(1);  // for processes that are not on the clock
constexpr milliseconds kWatchEvery(50);

Wall Now() { return time::SteadyClock().Now(); }

long Futex(std::atomic<std::uint32_t>* word, int operation, std::uint32_t value,
           const timespec* timeout = nullptr) {
  return ::syscall(SYS_futex, word, operation, value, timeout, nullptr, 0);
}

}  // namespace

Coordinator::Coordinator(Page* page, bool realtime, std::chrono::nanoseconds most_computing)
    : page_(*page), sleepers_(page), most_computing_(most_computing) {
  if (!realtime || !TakeFifo()) return;
  const sched_param usual{};
  ::sched_setscheduler(0, SCHED_OTHER, &usual);
  auto own = CoreOfOurOwn();
  if (!own) return;
  page_.core = own->first;
  core_ = std::move(own->second);
  page_.fifo = 1;
}

Coordinator::~Coordinator() = default;

std::string Coordinator::Begin() {
  loop_ = ::gettid();
  if (page_.fifo != 0) {
    watching_ = std::jthread([this](const std::stop_token& stop) { Watch(stop); });
  }
  Pin(page_.core);
  if (page_.fifo != 0 && !TakeFifo()) page_.fifo = 0;
  return "the program's clock is simulated; all threads on core " + std::to_string(page_.core) +
         (page_.fifo != 0 ? ", SCHED_FIFO granted" : ", without SCHED_FIFO");
}

// The library is in this process, but in tests.
void Coordinator::HoldMessages(bool hold) {
  static auto* const in_library =
      reinterpret_cast<void (*)(bool)>(::dlsym(RTLD_DEFAULT, "simclock_hold"));
  if (in_library != nullptr) in_library(hold);
}

void Coordinator::ProgramStarts() {
  program_started_ = Now();
  told_of_end_ = false;
}

void Coordinator::ProgramEnded() {
  told_of_end_ = true;
  ended_ = false;
}

bool Coordinator::Reach(Wall simulated, Wall most) {
  const Wall begun = Now();
  const std::int64_t target = kFirstInstant + simulated.count();
  if (begun > looked_for_strangers_ + kLookEvery) LookForStrangers(begun);
  while (Quiet(begun + most)) {
    if (ended_) break;
    const std::optional<std::uint32_t> next = Earliest(target);
    if (!next) {
      // A message that answers one of this step is later than the step.
      page_.now = std::max<std::int64_t>(page_.now, target + 1);
      return true;
    }
    page_.now = std::max<std::int64_t>(page_.now, page_.slots[*next].deadline);
    Fire(*next);
    if (Now() > begun + most) return false;
  }
  if (ended_) std::this_thread::sleep_for(kPatience);
  return false;
}

void Coordinator::Stand() {
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    const Slot& slot = page_.slots[i];
    if (slot.state == State::kBlocked && slot.kind == Kind::kAsks) Fire(i);
  }
}

void Coordinator::End() {
  if (coasting_.joinable()) return;
  coasting_ = std::jthread([this](const std::stop_token& stop) { Coast(stop); });
}

// The earliest wait that ends at `target` or before.
std::optional<std::uint32_t> Coordinator::Earliest(std::int64_t target) const {
  std::optional<std::uint32_t> found;
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    const Slot& slot = page_.slots[i];
    if (slot.state != State::kBlocked || slot.deadline > target) continue;
    if (!found || slot.deadline < page_.slots[*found].deadline) found = i;
  }
  return found;
}

void Coordinator::Fire(std::uint32_t index) {
  Slot& slot = page_.slots[index];
  State blocked = State::kBlocked;
  page_.running.fetch_add(1);
  if (!slot.state.compare_exchange_strong(blocked, State::kFired)) {  // woken meanwhile
    page_.running.fetch_sub(1);
    return;
  }
  Interrupt(&slot);
}

void Coordinator::Interrupt(Slot* slot) const {
  if (slot->kind == Kind::kEvent) {
    ::syscall(SYS_tgkill, slot->pid.load(), slot->tid.load(), page_.signal);
    return;
  }
  slot->wake.fetch_add(1);
  Futex(&slot->wake, FUTEX_WAKE, 1);
}

// Frees the slot of a thread that is gone, and with the first thread of the program all of its.
void Coordinator::Bury(std::uint32_t index) {
  const auto free = [this](Slot* slot) {
    const State before = slot->state.exchange(State::kFree);
    if (before != State::kBlocked && before != State::kFree) page_.running.fetch_sub(1);
  };
  free(&page_.slots[index]);
  const int pid = page_.slots[index].pid;
  if (pid == 0 || pid != page_.program || page_.slots[index].tid != pid) return;
  ended_ = !told_of_end_;  // its last thread may be seen gone after ProgramEnded()
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    if (page_.slots[i].pid == pid) free(&page_.slots[i]);
  }
}

// ---- whether all wait

// Waits until every thread waits; false if that lasts beyond `until`.
bool Coordinator::Quiet(Wall until) {
  const Wall since = Now();
  if (!ProgramHasBegun(since)) return false;
  for (Wall now = since;; now = Now()) {
    if (page_.fifo != 0 && page_.running == 0) break;  // else it would not be our turn
    if (page_.running > page_.loose) WaitForBell(kPatience);
    const bool patient = page_.fifo != 0 || Now() - since > kPatience;
    const std::uint64_t blocks = Blocks();
    const bool all_say = page_.running <= page_.loose;
    if ((all_say || patient) && AllAsleep(patient) && Blocks() == blocks) break;
    if (all_say && page_.fifo != 0) std::this_thread::sleep_for(kGlance);  // others have less
    if (all_say) ::sched_yield();
    if (Stalls(now)) return true;
    if (now > until) return false;
  }
  busy_since_.reset();
  busy_cpu_.clear();
  stalled_ = false;
  return true;
}

bool Coordinator::ProgramHasBegun(Wall now) {
  if (!program_started_) return true;
  if (page_.program != 0) {
    program_started_.reset();
    return true;
  }
  missing_ = now > *program_started_ + kProgramBegins;
  std::this_thread::sleep_for(kPatience);
  return false;
}

std::uint64_t Coordinator::Blocks() const {
  std::uint64_t sum = 0;
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    sum += page_.slots[i].blocks.load(std::memory_order_relaxed);
  }
  return sum;
}

// `patient`: also those that do not say that they wait are looked at.
bool Coordinator::AllAsleep(bool patient) {
  int loose = 0;
  for (std::uint32_t i = page_.used; i-- > 0;) {
    const Slot& slot = page_.slots[i];
    const State state = slot.state;
    if (state == State::kFree || (state == State::kBlocked && slot.kind != Kind::kEvent)) continue;
    if (state != State::kBlocked && !patient && page_.loose == 0) return false;
    switch (sleepers_.Look(i)) {
      case Sleep::kAwake:
        return false;
      case Sleep::kGone:
        // The first thread frees its slot if it ends by itself: here its process ends, or has
        // ended.
        if (slot.tid == slot.pid && slot.pid == page_.program && !HasEnded(slot.pid)) return false;
        Bury(i);
        break;
      case Sleep::kAsleep:
        if (slot.state == State::kFired) return false;  // its wake-up is on its way
        if (slot.state != State::kRunning || slot.kind == Kind::kStands) break;
        ++loose;
        NoteRawSleep(i);
        break;
    }
  }
  page_.loose = loose;
  return page_.running <= loose;
}

void Coordinator::WaitForBell(std::chrono::nanoseconds most) {
  const std::uint32_t heard = page_.bell;
  page_.listening = 1;
  if (page_.running > page_.loose) {
    const timespec timeout{.tv_sec = 0, .tv_nsec = most.count()};
    Futex(&page_.bell, FUTEX_WAIT, heard, &timeout);
  }
  page_.listening = 0;
}

// ---- what is amiss

// Whether a thread computes without end, so that time has to go on beside it.
bool Coordinator::Stalls(Wall now) {
  if (stalled_) {
    std::this_thread::sleep_for(kStalledStep);
    return true;
  }
  if (const std::uint32_t one = computing_; one > 0) return NoteStall(one - 1);
  if (!busy_since_) busy_since_ = now;
  if (now < *busy_since_ + seconds(1)) return false;
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    if (page_.slots[i].state == State::kFree || page_.slots[i].pid == 0) continue;
    if (sleepers_.Look(i) != Sleep::kAwake) continue;
    const std::int64_t cpu = sleepers_.CpuOf(i);
    const std::int64_t before = busy_cpu_.try_emplace(i, cpu).first->second;
    const bool computes = cpu - before > most_computing_.count();
    if (!computes && now < *busy_since_ + kMostSleeping) continue;
    return NoteStall(i);
  }
  return false;
}

bool Coordinator::NoteStall(std::uint32_t computing) {
  NoteUnrepeatable(sleepers_.Describe(computing) +
                   " computes and does not wait: time goes on beside it");
  stalled_ = true;
  return true;
}

// Looks for a thread that computes while time stands, as the loop cannot.
void Coordinator::Watch(const std::stop_token& stop) {
  KeepOff(page_.core);
  const Sleepers sleepers(&page_);
  std::int64_t before = -1;
  std::map<std::uint32_t, std::int64_t> cpu;  // when time began to stand, by slot
  for (; !stop.stop_requested(); std::this_thread::sleep_for(kWatchEvery)) {
    if (const std::int64_t now = page_.now; now != before) {
      before = now;
      cpu.clear();
    }
    for (std::uint32_t i = 0; i < page_.used; ++i) {
      // Those too that say that they wait: in a handler of signals, or in the kernel.
      if (page_.slots[i].state == State::kFree || page_.slots[i].pid == 0) continue;
      const std::int64_t had = sleepers.CpuOf(i);
      if (had - cpu.try_emplace(i, had).first->second > most_computing_.count()) {
        return TakePriority(i);
      }
    }
  }
}

void Coordinator::TakePriority(std::uint32_t computing) {
  computing_ = computing + 1;
  page_.fifo = 0;
  const sched_param usual{};
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    const Slot& slot = page_.slots[i];
    if (slot.state != State::kFree && slot.tid > 0) {
      ::sched_setscheduler(slot.tid, SCHED_OTHER, &usual);
    }
  }
  ::sched_setscheduler(loop_, SCHED_OTHER, &usual);
}

// A program that asks the kernel by itself, past libc, sleeps in real time.
void Coordinator::NoteRawSleep(std::uint32_t index) {
  const std::string call = sleepers_.CallOf(index);
  if (call != "nanosleep" && call != "clock_nanosleep") return;
  if (!raw_sleepers_.insert(page_.slots[index].tid).second) return;
  if (!HasLibrary(page_.slots[index].pid)) return;  // LookForStrangers() will say so
  NoteUnrepeatable(sleepers_.Describe(index) + " sleeps in real time, by a system call of its own");
}

void Coordinator::NoteUnrepeatable(const std::string& why) {
  if (unrepeatable_.empty()) unrepeatable_ = why;
  spdlog::warn("clock: {}; two runs may differ", why);
}

// Programs that were started by one on the clock and are not on it: static ones, of Go.
void Coordinator::LookForStrangers(Wall now) {
  looked_for_strangers_ = now;
  if (page_.refused.exchange(0) > 0) {
    NoteUnrepeatable("there are more than " + std::to_string(kMostThreads) + " threads");
  }
  std::set<int> pids;
  for (std::uint32_t i = 0; i < page_.used; ++i) {
    const Slot& slot = page_.slots[i];
    if (slot.state == State::kFree || slot.pid == 0 || slot.pid == page_.robot) continue;
    pids.insert(slot.pid);
    std::ifstream children("/proc/" + std::to_string(slot.pid) + "/task/" +
                           std::to_string(slot.tid) + "/children");
    for (int child = 0; children >> child;) pids.insert(child);
  }
  std::erase_if(suspects_, [&](const auto& one) { return !pids.contains(one.first); });
  for (const int pid : pids) {
    std::error_code gone;
    const std::string file =
        std::filesystem::read_symlink("/proc/" + std::to_string(pid) + "/exe", gone).string();
    const auto [known, is_new] = known_.try_emplace(pid);
    if (gone || (!is_new && known->second == file)) continue;
    if (HasLibrary(pid)) {
      known->second = file;
    } else if (const Wall seen = suspects_.try_emplace(pid, now).first->second;
               now >= seen + kLookEvery) {
      known->second = file;
      NoteUnrepeatable(NameOfProcess(pid) + " (" + std::to_string(pid) +
                       ") did not take the clock and is on real time");
    }
  }
}

// Ends waits without looking who sleeps. A signal that comes before its wait is sent again.
void Coordinator::Coast(const std::stop_token& stop) {
  const std::int64_t start = page_.now;
  const Wall begun = Now();
  while (!stop.stop_requested()) {
    page_.now = start + (Now() - begun).count();
    for (std::uint32_t i = 0; i < page_.used; ++i) {
      Slot& slot = page_.slots[i];
      if (slot.state == State::kFired) Interrupt(&slot);
      if (slot.state == State::kBlocked && slot.deadline <= page_.now) Fire(i);
    }
    std::this_thread::sleep_for(kStalledStep);
  }
}

}  // namespace understudy::simclock
