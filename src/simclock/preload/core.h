// What the files of libsimclock.so share. The library is preloaded into a program and answers its
// clocks and waits by the page; what it does not simulate goes to libc. It links nothing but libc.
//
// In the robot's own process only Cyclone DDS lives on the clock: the clock that its code reads and
// the waits of the threads that it makes. All else there is on real time.
#pragma once

#include <atomic>
#include <cerrno>
#include <cstdint>
#include <ctime>

#include <dlfcn.h>
#include <sys/time.h>

#include "simclock/page.h"

#define SIMCLOCK_EXPORT extern "C" __attribute__((visibility("default")))
// libc's own function of that name.
#define REAL(name)                                                                 \
  ([]() -> decltype(&::name) {                                                     \
    static decltype(&::name) real =                                                \
        reinterpret_cast<decltype(&::name)>(dlsym(RTLD_NEXT, #name)); /* NOLINT */ \
    return real;                                                                   \
  }())
#define CALLER __builtin_return_address(0)

namespace understudy::simclock {

inline constexpr std::int64_t kSecond = 1'000'000'000;

extern Page* page;     // null: the process is not on the clock
extern bool in_robot;  // it is the robot's
extern int page_file;  // the descriptor of the page; programs do not close it

// Whether code at `caller` reads the simulated clock.
bool OnClock(const void* caller);
// The slot by which this thread waits; null: it waits in real time.
Slot* Waiter();
// Whether the deadlines of this thread are simulated.
inline bool Waits() { return page != nullptr && Waiter() != nullptr; }
bool TimeStands();  // for this thread, which is on real time
// Whether threads keep the core and the policy that the clock gave them.
inline bool Keeps() { return page != nullptr && !in_robot; }
// Whether the timers of this thread are simulated.
inline bool HasTimers() { return Keeps() && !TimeStands(); }

void Collect();             // this thread is Cyclone's collector of garbage
void MakeSlotKey();         // before there are other threads
Slot* TakeSlot();           // for a thread that is about to begin; null: there is none
void FreeSlot(Slot* slot);  // null: does nothing
void LeaveClock();          // this thread lives on real time from now on
void Adopt(Slot* slot);     // of this thread from now on
void AdoptCore();           // runs this thread as the page wants it
bool TakePriority();        // of this thread, if the page wants it; false: it has no right to
void LeavePriority();       // until it takes it again
std::int32_t ThreadId();

// Says that this thread waits, and no longer.
void Block(const char* what, Kind kind, std::int64_t deadline);
bool Unblock();  // returns whether the deadline ended the wait

// Simulated CLOCK_MONOTONIC [ns]. A thread that reads it again and again without waiting is made to
// wait, so that a loop over the clock ends; `weight` is how many reads this counts as.
std::int64_t Now();
std::int64_t Read(int weight = 1);

inline std::int64_t Ns(const timespec& t) { return t.tv_sec * kSecond + t.tv_nsec; }
inline std::int64_t Ns(const timeval& t) { return t.tv_sec * kSecond + t.tv_usec * 1000; }
inline timespec Spec(std::int64_t ns) {
  if (ns < 0) ns = 0;
  return {.tv_sec = ns / kSecond, .tv_nsec = ns % kSecond};
}
inline timeval Micros(std::int64_t ns) {
  if (ns < 0) ns = 0;
  return {.tv_sec = ns / kSecond, .tv_usec = ns % kSecond / 1000};
}
inline std::int64_t After(std::int64_t ns) {
  const std::int64_t now = Now();
  return ns > kNever - now ? kNever : now + ns;
}
inline std::int64_t AfterMs(int ms) {
  return ms < 0 ? kNever : After(ms * std::int64_t{1'000'000});
}
// A null time is never.
inline std::int64_t After(const timespec* t) { return t == nullptr ? kNever : After(Ns(*t)); }

bool IsSimulated(clockid_t clock);
bool IsDate(clockid_t clock);
// A time of that clock as simulated CLOCK_MONOTONIC.
inline std::int64_t From(clockid_t clock, const timespec& t) {
  return IsDate(clock) ? Ns(t) - (kFirstDate - kFirstInstant) : Ns(t);
}

// Raw system call: returns -errno.
long Futex(void* word, int operation, std::uint32_t value, const timespec* timeout = nullptr,
           std::uint32_t mask = 0xffffffffU);

// Returns 0 at the deadline or EINTR.
int SleepUntil(std::int64_t deadline, const char* what, Kind kind = Kind::kSleep);
void SleepThrough(std::int64_t deadline, const char* what);
// FUTEX_WAIT: returns 0, EAGAIN, EINTR or ETIMEDOUT.
int FutexWait(void* word, std::uint32_t value, std::uint32_t mask, bool is_private,
              std::int64_t deadline, const char* what);

// Waits in a system call that has no time-out: `call()` returns below 0 and EINTR at the deadline,
// and then `last()` looks once more without waiting.
template <typename Call, typename Last>
auto WaitIn(const char* what, std::int64_t deadline, Call call, Last last) -> decltype(call()) {
  Block(what, Kind::kEvent, deadline);
  auto result = call();
  const int error = errno;
  if (Unblock() && result < 0 && error == EINTR) return last();
  errno = error;
  return result;
}
// The same for ever.
template <typename Call>
auto WaitIn(const char* what, Call call) -> decltype(call()) {
  return WaitIn(what, kNever, call, call);
}

// Tries again every 0.2 ms of simulated time, *assumed*, until `attempt` says another thing than
// `busy`.
template <typename Attempt>
int TryUntil(std::int64_t deadline, int busy, Attempt attempt) {
  constexpr std::int64_t kStep = 200'000;
  for (;;) {
    const int error = attempt();
    if (error != busy) return error;
    const std::int64_t now = Now();
    if (now >= deadline) return ETIMEDOUT;
    SleepThrough(now + kStep < deadline ? now + kStep : deadline, "timedlock");
  }
}

// A thread that has slept takes the time of `--think` to its next message; what it computed until
// then is counted.
void BeginThinking();
void Think();

}  // namespace understudy::simclock
