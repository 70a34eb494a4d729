#include "simclock/trace.h"

#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <stop_token>

#include "base/printed.h"

namespace understudy::simclock {
namespace {

// Simulated s since the first step.
double Seconds(std::int64_t instant) { return 1e-9 * static_cast<double>(instant - kFirstInstant); }

// What the thread of a slot does, as "waits in sleep until 2.5 s".
std::string DoesText(const Slot& slot, std::uint32_t index, const Sleepers& sleepers) {
  const State state = slot.state;
  if (slot.tid == 0) return "begins";
  if (state == State::kFired) return "wakes: its time has come";
  if (state == State::kBlocked) {
    const std::int64_t deadline = slot.deadline;
    return std::string("waits in ") + slot.what.data() +
           (deadline == kNever ? " for an event, without a time-out"
                               : Printed(" until %.6f s", Seconds(deadline)));
  }
  const std::string call = sleepers.CallOf(index);
  const double cpu = 1e-9 * static_cast<double>(sleepers.CpuOf(index));
  return call.empty() ? Printed("computes, %.3f s of the processor so far", cpu)
                      : "sleeps in " + call + ", which the clock does not end";
}

}  // namespace

std::string WaitsText(const Page& page, const Sleepers& sleepers, bool stands) {
  std::string text = Printed("clock: %.6f s%s\n", Seconds(page.now),
                             stands ? ", where it has stood since it was last told" : "");
  for (std::uint32_t i = 0; i < page.used; ++i) {
    const Slot& slot = page.slots[i];
    if (slot.state == State::kFree) continue;
    text += "  " + sleepers.Describe(i) + ": " + DoesText(slot, i, sleepers) + "\n";
  }
  return text;
}

WaitTrace::WaitTrace(Page* page, Say say, std::chrono::milliseconds period)
    : page_(*page),
      sleepers_(page),
      say_(std::move(say)),
      thread_([this, period](const std::stop_token& stop) { Tell(stop, period); }) {}

void WaitTrace::Tell(const std::stop_token& stop, std::chrono::milliseconds period) {
  std::mutex mutex;
  std::condition_variable_any wake;
  std::unique_lock lock(mutex);
  std::string told;
  for (std::int64_t before = -1; !wake.wait_for(lock, stop, period, [] { return false; });) {
    if (stop.stop_requested()) return;
    const std::int64_t now = page_.now;
    std::string text = WaitsText(page_, sleepers_, now == before);
    if (text != told) say_(text);
    told = std::move(text);
    before = now;
  }
}

}  // namespace understudy::simclock
