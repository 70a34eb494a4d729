// Reading clocks, and sleeping.
#include <sched.h>
#include <threads.h>
#include <unistd.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

SIMCLOCK_EXPORT int clock_gettime(clockid_t clock, timespec* t) noexcept {
  if (!IsSimulated(clock) || !OnClock(CALLER)) return REAL(clock_gettime)(clock, t);
  *t = Spec(Read() + (IsDate(clock) ? kFirstDate - kFirstInstant : 0));
  return 0;
}

namespace {
std::int64_t Date() { return Read() + kFirstDate - kFirstInstant; }
}  // namespace

SIMCLOCK_EXPORT int gettimeofday(timeval* t, void* zone) noexcept {
  if (!OnClock(CALLER)) return REAL(gettimeofday)(t, zone);
  *t = Micros(Date());
  return 0;
}
SIMCLOCK_EXPORT time_t time(time_t* t) noexcept {
  if (!OnClock(CALLER)) return REAL(time)(t);
  const time_t seconds = Date() / kSecond;
  if (t != nullptr) *t = seconds;
  return seconds;
}
SIMCLOCK_EXPORT int timespec_get(timespec* t, int base) noexcept {
  if (base != TIME_UTC || !OnClock(CALLER)) return REAL(timespec_get)(t, base);
  *t = Spec(Date());
  return base;
}

SIMCLOCK_EXPORT int sched_yield() noexcept {
  if (OnClock(CALLER)) Read(50);  // *assumed*: one that yields waits for somebody
  return REAL(sched_yield)();
}

SIMCLOCK_EXPORT int clock_nanosleep(clockid_t clock, int flags, const timespec* t, timespec* left) {
  if (!IsSimulated(clock) || !Waits()) return REAL(clock_nanosleep)(clock, flags, t, left);
  if (t->tv_nsec < 0 || t->tv_nsec >= kSecond || t->tv_sec < 0) return EINVAL;
  const bool absolute = (flags & TIMER_ABSTIME) != 0;
  const std::int64_t deadline = absolute ? From(clock, *t) : After(Ns(*t));
  const int error = SleepUntil(deadline, "sleep");
  BeginThinking();
  if (error == EINTR && !absolute && left != nullptr) *left = Spec(deadline - Now());
  return error;
}

namespace {
// As nanosleep(2).
int Nanosleep(std::int64_t ns, timespec* left) {
  const timespec t = Spec(ns);
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, &t, left);
  if (error == 0) return 0;
  errno = error;
  return -1;
}
}  // namespace

SIMCLOCK_EXPORT int nanosleep(const timespec* t, timespec* left) {
  if (!Waits()) return REAL(nanosleep)(t, left);
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, t, left);
  if (error == 0) return 0;
  errno = error;
  return -1;
}
SIMCLOCK_EXPORT int usleep(useconds_t us) {
  return Waits() ? Nanosleep(us * std::int64_t{1000}, nullptr) : REAL(usleep)(us);
}
SIMCLOCK_EXPORT unsigned sleep(unsigned seconds) {
  if (!Waits()) return REAL(sleep)(seconds);
  timespec left{};
  if (Nanosleep(seconds * kSecond, &left) == 0) return 0;
  return static_cast<unsigned>(left.tv_sec + (left.tv_nsec > 0 ? 1 : 0));
}
SIMCLOCK_EXPORT int thrd_sleep(const timespec* t, timespec* left) {
  if (!Waits()) return REAL(thrd_sleep)(t, left);
  const int error = clock_nanosleep(CLOCK_MONOTONIC, 0, t, left);
  return error == 0 ? 0 : error == EINTR ? -1 : -2;
}
