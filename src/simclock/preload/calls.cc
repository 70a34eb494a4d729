// System calls that a program makes by number (libstdc++'s futures and semaphores, Rust, abseil),
// and waits for signals and queues.
#include <cstdarg>

#include <aio.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <signal.h>
#include <sys/sem.h>
#include <sys/syscall.h>
#include <unistd.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

long Result(int error) {
  if (error == 0) return 0;
  errno = error;
  return -1;
}

long FutexCall(const long* a) {
  const bool bitset = (a[1] & FUTEX_CMD_MASK) == FUTEX_WAIT_BITSET;
  const auto* const t = reinterpret_cast<const timespec*>(a[3]);
  const bool date = (a[1] & FUTEX_CLOCK_REALTIME) != 0;
  const std::int64_t deadline = t == nullptr ? kNever
                                : bitset     ? From(date ? CLOCK_REALTIME : CLOCK_MONOTONIC, *t)
                                             : After(Ns(*t));
  return Result(FutexWait(reinterpret_cast<void*>(a[0]), static_cast<std::uint32_t>(a[2]),
                          bitset ? static_cast<std::uint32_t>(a[5]) : FUTEX_BITSET_MATCH_ANY,
                          (a[1] & FUTEX_PRIVATE_FLAG) != 0, deadline, "futex"));
}

template <typename Call>
auto WaitOrTimeOut(std::int64_t deadline, int error, Call call) -> decltype(call()) {
  if (deadline <= Now()) deadline = Now() + 1;
  return WaitIn("queue", deadline, call, [error]() -> decltype(call()) {
    errno = error;
    return -1;
  });
}

}  // namespace

SIMCLOCK_EXPORT long syscall(long number, ...) noexcept {
  va_list list;
  va_start(list, number);
  long a[6];
  for (long& one : a) one = va_arg(list, long);
  va_end(list);
  static const auto real = reinterpret_cast<long (*)(long, ...)>(dlsym(RTLD_NEXT, "syscall"));
  if (page != nullptr && !in_robot) {
    const long operation = a[1] & FUTEX_CMD_MASK;
    const auto clock = static_cast<clockid_t>(a[0]);
    switch (number) {
      case SYS_futex:
        if ((operation == FUTEX_WAIT || operation == FUTEX_WAIT_BITSET) && Waits()) {
          return FutexCall(a);
        }
        break;
      case SYS_clock_gettime:
        return clock_gettime(clock, reinterpret_cast<timespec*>(a[1]));
      case SYS_gettimeofday:
        return gettimeofday(reinterpret_cast<timeval*>(a[0]), nullptr);
      case SYS_nanosleep:
        return nanosleep(reinterpret_cast<const timespec*>(a[0]),
                         reinterpret_cast<timespec*>(a[1]));
      case SYS_clock_nanosleep:
        return Result(clock_nanosleep(clock, static_cast<int>(a[1]),
                                      reinterpret_cast<const timespec*>(a[2]),
                                      reinterpret_cast<timespec*>(a[3])));
      default:
        break;
    }
  }
  return real(number, a[0], a[1], a[2], a[3], a[4], a[5]);
}

SIMCLOCK_EXPORT int sigwaitinfo(const sigset_t* set, siginfo_t* info) {
  if (!Waits()) return REAL(sigwaitinfo)(set, info);
  return WaitIn("signal", [=] { return REAL(sigwaitinfo)(set, info); });
}
SIMCLOCK_EXPORT int sigwait(const sigset_t* set, int* signal) {
  if (!Waits()) return REAL(sigwait)(set, signal);
  return WaitIn("signal", [=] { return REAL(sigwait)(set, signal); });
}
SIMCLOCK_EXPORT int sigtimedwait(const sigset_t* set, siginfo_t* info, const timespec* t) {
  if (!Waits()) return REAL(sigtimedwait)(set, info, t);
  constexpr timespec kAtOnce{};
  const auto look = [=] { return REAL(sigtimedwait)(set, info, &kAtOnce); };
  if (const int signal = look(); signal > 0 || (t != nullptr && Ns(*t) == 0)) return signal;
  return WaitIn(
      "signal", After(t), [=] { return REAL(sigwaitinfo)(set, info); }, look);
}
SIMCLOCK_EXPORT int pause() {
  return Waits() ? WaitIn("signal", [] { return REAL(pause)(); }) : REAL(pause)();
}
SIMCLOCK_EXPORT int sigsuspend(const sigset_t* mask) {
  if (!Waits()) return REAL(sigsuspend)(mask);
  sigset_t open = *mask;
  sigdelset(&open, page->signal);
  return WaitIn("signal", [&open] { return REAL(sigsuspend)(&open); });
}

SIMCLOCK_EXPORT ssize_t mq_timedreceive(mqd_t queue, char* at, size_t n, unsigned* priority,
                                        const timespec* t) {
  if (!Waits()) return REAL(mq_timedreceive)(queue, at, n, priority, t);
  return WaitOrTimeOut(From(CLOCK_REALTIME, *t), ETIMEDOUT,
                       [=] { return REAL(mq_receive)(queue, at, n, priority); });
}
SIMCLOCK_EXPORT int mq_timedsend(mqd_t queue, const char* at, size_t n, unsigned priority,
                                 const timespec* t) {
  if (!Waits()) return REAL(mq_timedsend)(queue, at, n, priority, t);
  return WaitOrTimeOut(From(CLOCK_REALTIME, *t), ETIMEDOUT,
                       [=] { return REAL(mq_send)(queue, at, n, priority); });
}
SIMCLOCK_EXPORT int semtimedop(int set, sembuf* operations, size_t n, const timespec* t) noexcept {
  if (!Waits()) return REAL(semtimedop)(set, operations, n, t);
  return WaitOrTimeOut(After(t), EAGAIN, [=] { return REAL(semop)(set, operations, n); });
}
SIMCLOCK_EXPORT int aio_suspend(const aiocb* const list[], int n, const timespec* t) {
  if (!Waits()) return REAL(aio_suspend)(list, n, t);
  constexpr timespec kAtOnce{};
  const int error = TryUntil(After(t), EAGAIN,
                             [=] { return REAL(aio_suspend)(list, n, &kAtOnce) == 0 ? 0 : errno; });
  if (error == ETIMEDOUT) errno = EAGAIN;
  return error == 0 ? 0 : -1;
}
