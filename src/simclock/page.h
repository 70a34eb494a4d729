// The page of memory by which a robot's process and the programs on its clock share one time. The
// coordinator writes the time; each thread of a program writes that it waits, and until when. Both
// sides come from one build: `kVersion` and the layout belong to it.
#pragma once

#include <array>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace understudy::simclock {

inline constexpr std::uint32_t kMagic = 0x554e4443U;
inline constexpr std::uint32_t kVersion = 3;
inline constexpr std::uint32_t kMostThreads = 1024;  // *assumed*, of all programs together
inline constexpr std::int64_t kNever = INT64_MAX;
// Has the number of the descriptor of the page, which programs inherit.
inline constexpr char kPageVariable[] = "UNDERSTUDY_CLOCK";

// When the run starts, by CLOCK_MONOTONIC [ns] and CLOCK_REALTIME (2026-01-01 00:00:00 UTC) [ns]:
// the same in each run, so that what a program makes of the date repeats.
inline constexpr std::int64_t kFirstInstant = 1'000'000'000'000;
inline constexpr std::int64_t kFirstDate = 1'767'225'600'000'000'000;

enum class State : std::uint32_t {
  kFree,     // no thread has the slot
  kRunning,  // the thread computes, or has not yet begun
  kBlocked,  // it waits until its deadline or for an event
  kFired,    // its deadline has come, and it has not yet run
};

// How the coordinator ends a wait at its deadline.
enum class Kind : std::uint32_t {
  kSleep,   // by a futex, `Slot::wake`: nothing else ends it
  kEvent,   // by a signal that interrupts the system call
  kAsks,    // as kSleep, and by a pause: what it will ask may end that
  kStands,  // not at all: the thread is on real time, and simulated time stands
};

// One thread.
struct alignas(64) Slot {
  std::atomic<State> state;
  std::atomic<Kind> kind;
  std::atomic<std::int64_t> deadline;  // ns, kNever
  std::atomic<std::uint32_t> wake;
  std::atomic<std::int32_t> pid, tid;  // 0: not yet known, counts as running
  std::atomic<std::uint32_t> blocks;   // how often it has waited
  std::array<char, 16> what;           // the call in which it waits
};

// How long threads compute, in steps of a sixteenth of each power of two [ns].
inline constexpr std::size_t kSpans = 16 * 60;
inline constexpr std::size_t SpanOf(std::int64_t ns) {
  if (ns < 16) return ns < 0 ? 0 : static_cast<std::size_t>(ns);
  const auto time = static_cast<std::uint64_t>(ns);
  const int shift = static_cast<int>(std::bit_width(time)) - 5;  // what remains has five bits
  return 16 * static_cast<std::size_t>(shift) + static_cast<std::size_t>(time >> shift);
}
// The shortest time of a span [ns].
inline constexpr std::int64_t LeastOf(std::size_t span) {
  if (span < 32) return static_cast<std::int64_t>(span);
  return static_cast<std::int64_t>(16 + span % 16) << (span / 16 - 1);
}

struct Page {
  std::uint32_t magic, version;
  std::int32_t robot;               // the robot's process
  std::int32_t loaded;              // the library is in that process
  std::int32_t signal;              // that ends waits of Kind::kEvent
  std::int32_t core;                // on which all threads run
  std::int64_t think;               // ns from the end of a sleep to the next message of that thread
  std::atomic<std::uint32_t> fifo;  // threads run under SCHED_FIFO, above the coordinator
  std::atomic<std::int32_t> program;   // the first process that took the clock; 0: none has
  std::atomic<std::uint32_t> refused;  // threads for which there was no slot
  std::atomic<std::uint32_t> spins;    // waits of threads that only read the clock
  // How often a thread took how much of the processor's time from the end of a sleep to its next
  // message, by SpanOf().
  std::array<std::atomic<std::uint32_t>, kSpans> computed;

  alignas(64) std::atomic<std::int64_t> now;      // ns, CLOCK_MONOTONIC of the programs
  alignas(64) std::atomic<std::int32_t> running;  // threads that do not say that they wait
  std::atomic<std::int32_t> loose;  // of those, asleep in a call that the library does not know
  std::atomic<std::uint32_t> bell;  // a futex: rung when `running` falls to `loose`
  std::atomic<std::uint32_t> listening;  // the coordinator waits for it
  std::atomic<std::uint32_t> used;       // slots from here on were never used

  std::array<Slot, kMostThreads> slots;
};

}  // namespace understudy::simclock
