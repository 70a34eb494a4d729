// Condition variables: our own, in the memory of libc's, since a signal cannot end a wait in those.
#include <climits>
#include <cstring>

#include <linux/futex.h>
#include <pthread.h>
#include <threads.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

// All zero is PTHREAD_COND_INITIALIZER.
struct Condition {
  std::atomic<std::uint32_t> sequence;
  clockid_t clock;  // CLOCK_REALTIME is 0
  int shared;       // between processes
};
static_assert(sizeof(Condition) <= sizeof(pthread_cond_t) && CLOCK_REALTIME == 0);
static_assert(sizeof(cnd_t) == sizeof(pthread_cond_t) && sizeof(mtx_t) == sizeof(pthread_mutex_t));

Condition* Of(void* at) { return static_cast<Condition*>(at); }
pthread_cond_t* Posix(cnd_t* at) { return reinterpret_cast<pthread_cond_t*>(at); }
pthread_mutex_t* Posix(mtx_t* at) { return reinterpret_cast<pthread_mutex_t*>(at); }

// For a thread on real time, in the robot's process. The deadline is simulated if Cyclone made it.
int WaitReally(Condition* condition, std::uint32_t sequence, clockid_t clock, const timespec* t,
               bool simulated) {
  const bool date = IsDate(clock) && !simulated;
  timespec until{};
  if (t != nullptr && simulated) {
    REAL(clock_gettime)(CLOCK_MONOTONIC, &until);
    until = Spec(Ns(until) + From(clock, *t) - Now());
  } else if (t != nullptr) {
    until = *t;
  }
  const int operation = FUTEX_WAIT_BITSET | (condition->shared != 0 ? 0 : FUTEX_PRIVATE_FLAG) |
                        (date ? FUTEX_CLOCK_REALTIME : 0);
  return static_cast<int>(
      -Futex(&condition->sequence, operation, sequence, t == nullptr ? nullptr : &until));
}

int Wait(pthread_cond_t* at, pthread_mutex_t* mutex, clockid_t clock, const timespec* t,
         const void* caller) {
  Condition* const condition = Of(at);
  if (t != nullptr && (t->tv_nsec < 0 || t->tv_nsec >= kSecond)) return EINVAL;
  const bool waits = Waits();
  const std::int64_t deadline = t == nullptr ? kNever : From(clock, *t);
  const std::uint32_t sequence = condition->sequence.load();
  if (const int error = pthread_mutex_unlock(mutex)) return error;
  int error = 0;
  do {
    error = waits ? FutexWait(&condition->sequence, sequence, FUTEX_BITSET_MATCH_ANY,
                              condition->shared == 0, deadline, "condition")
                  : WaitReally(condition, sequence, clock, t, OnClock(caller));
  } while (error == EINTR);
  pthread_mutex_lock(mutex);
  return error == ETIMEDOUT ? ETIMEDOUT : 0;
}

int Wake(pthread_cond_t* at, int most) {
  Condition* const condition = Of(at);
  condition->sequence.fetch_add(1);
  Futex(&condition->sequence, FUTEX_WAKE | (condition->shared != 0 ? 0 : FUTEX_PRIVATE_FLAG),
        static_cast<std::uint32_t>(most));
  return 0;
}

int ThreadsCode(int error) {
  return error == 0 ? thrd_success : error == ETIMEDOUT ? thrd_timedout : thrd_error;
}

}  // namespace

SIMCLOCK_EXPORT int pthread_cond_init(pthread_cond_t* at, const pthread_condattr_t* with) noexcept {
  if (page == nullptr) return REAL(pthread_cond_init)(at, with);
  std::memset(at, 0, sizeof(*at));
  if (with == nullptr) return 0;
  pthread_condattr_getclock(with, &Of(at)->clock);
  pthread_condattr_getpshared(with, &Of(at)->shared);
  return 0;
}
SIMCLOCK_EXPORT int pthread_cond_destroy(pthread_cond_t* at) noexcept {
  return page == nullptr ? REAL(pthread_cond_destroy)(at) : 0;
}
SIMCLOCK_EXPORT int pthread_cond_wait(pthread_cond_t* at, pthread_mutex_t* mutex) {
  if (page == nullptr) return REAL(pthread_cond_wait)(at, mutex);
  return Wait(at, mutex, CLOCK_MONOTONIC, nullptr, CALLER);
}
SIMCLOCK_EXPORT int pthread_cond_timedwait(pthread_cond_t* at, pthread_mutex_t* mutex,
                                           const timespec* t) {
  if (page == nullptr) return REAL(pthread_cond_timedwait)(at, mutex, t);
  return Wait(at, mutex, Of(at)->clock, t, CALLER);
}
SIMCLOCK_EXPORT int pthread_cond_clockwait(pthread_cond_t* at, pthread_mutex_t* mutex,
                                           clockid_t clock, const timespec* t) {
  if (page == nullptr) return REAL(pthread_cond_clockwait)(at, mutex, clock, t);
  return Wait(at, mutex, clock, t, CALLER);
}
SIMCLOCK_EXPORT int pthread_cond_signal(pthread_cond_t* at) noexcept {
  return page == nullptr ? REAL(pthread_cond_signal)(at) : Wake(at, 1);
}
SIMCLOCK_EXPORT int pthread_cond_broadcast(pthread_cond_t* at) noexcept {
  return page == nullptr ? REAL(pthread_cond_broadcast)(at) : Wake(at, INT_MAX);
}

SIMCLOCK_EXPORT int cnd_init(cnd_t* at) {
  if (page == nullptr) return REAL(cnd_init)(at);
  return ThreadsCode(pthread_cond_init(Posix(at), nullptr));
}
SIMCLOCK_EXPORT void cnd_destroy(cnd_t* at) {
  if (page == nullptr) REAL(cnd_destroy)(at);
}
SIMCLOCK_EXPORT int cnd_wait(cnd_t* at, mtx_t* mutex) {
  if (page == nullptr) return REAL(cnd_wait)(at, mutex);
  return ThreadsCode(Wait(Posix(at), Posix(mutex), CLOCK_MONOTONIC, nullptr, CALLER));
}
SIMCLOCK_EXPORT int cnd_timedwait(cnd_t* at, mtx_t* mutex, const timespec* t) {
  if (page == nullptr) return REAL(cnd_timedwait)(at, mutex, t);
  return ThreadsCode(Wait(Posix(at), Posix(mutex), CLOCK_REALTIME, t, CALLER));
}
SIMCLOCK_EXPORT int cnd_signal(cnd_t* at) {
  return page == nullptr ? REAL(cnd_signal)(at) : Wake(Posix(at), 1);
}
SIMCLOCK_EXPORT int cnd_broadcast(cnd_t* at) {
  return page == nullptr ? REAL(cnd_broadcast)(at) : Wake(Posix(at), INT_MAX);
}
