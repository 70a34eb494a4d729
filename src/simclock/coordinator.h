// Lets simulated time go on when every thread of the programs waits.
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <thread>

#include "base/unique_fd.h"
#include "simclock/page.h"
#include "simclock/sleepers.h"
#include "time/program_clock.h"

namespace understudy::simclock {

// The waits of the programs end one after the other, the earliest first, of equal ones that of the
// lower slot; after each it waits until every thread waits again. What programs compute takes no
// simulated time.
//
// All threads share a core. With the right to SCHED_FIFO they run above the loop's thread, which
// therefore has the core only when all of them sleep. Without it, it looks into /proc. A thread
// that computes without end would keep the loop from the core for ever: another thread takes the
// priority from all then.
class Coordinator final : public time::ProgramClock {
 public:
  // `page` must outlive this. `realtime`: whether to ask for SCHED_FIFO. A thread that computes for
  // `most_computing` of the processor's time between two waits is not waited for; *assumed*: the
  // longest imports of Python take half of it. Make it before Cyclone's threads.
  Coordinator(Page* page, bool realtime,
              std::chrono::nanoseconds most_computing = std::chrono::seconds(10));
  ~Coordinator() override;
  Coordinator(const Coordinator&) = delete;
  Coordinator& operator=(const Coordinator&) = delete;

  std::string Begin() override;
  bool Reach(time::Clock::Time simulated, time::Clock::Time most) override;
  void HoldMessages(bool hold) override;
  void ProgramStarts() override;
  void ProgramEnded() override;
  void End() override;
  void Stand() override;

  // Whether the program has not taken the clock for so long that it never will.
  bool program_is_missing() const { return missing_; }

  // Whether threads run under SCHED_FIFO, on a core of their own.
  bool has_priority() const { return page_.fifo != 0; }

  // Why two runs may differ; "" while there is no cause.
  const std::string& unrepeatable() const { return unrepeatable_; }

 private:
  bool Quiet(time::Clock::Time until);
  bool ProgramHasBegun(time::Clock::Time now);
  bool AllAsleep(bool patient);
  void WaitForBell(std::chrono::nanoseconds most);
  std::uint64_t Blocks() const;
  std::optional<std::uint32_t> Earliest(std::int64_t target) const;
  void Fire(std::uint32_t index);
  void Interrupt(Slot* slot) const;
  void Bury(std::uint32_t index);
  bool Stalls(time::Clock::Time now);
  bool NoteStall(std::uint32_t computing);
  void NoteRawSleep(std::uint32_t index);
  void NoteUnrepeatable(const std::string& why);
  void LookForStrangers(time::Clock::Time now);
  void Coast(const std::stop_token& stop);
  void Watch(const std::stop_token& stop);
  void TakePriority(std::uint32_t computing);

  Page& page_;
  Sleepers sleepers_;
  std::chrono::nanoseconds most_computing_;
  UniqueFd core_;  // its lock
  std::optional<time::Clock::Time> program_started_{};
  bool missing_ = false;
  bool ended_ = false;  // and nobody knows
  bool told_of_end_ = false;
  // Since when it waits for a thread that computes, and what that had computed before.
  std::optional<time::Clock::Time> busy_since_{};
  std::map<std::uint32_t, std::int64_t> busy_cpu_{};
  bool stalled_ = false;
  std::string unrepeatable_;
  time::Clock::Time looked_for_strangers_{};
  std::map<int, std::string> known_;  // process to its file, on the clock
  std::map<int, time::Clock::Time> suspects_;
  std::set<int> raw_sleepers_;  // threads
  int loop_ = 0;                // its thread
  std::atomic<std::uint32_t> computing_ =
      0;  // the slot, plus 1, for which TakePriority() was called
  std::jthread coasting_;
  std::jthread watching_;
};

}  // namespace understudy::simclock
