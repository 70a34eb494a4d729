// Semaphores and locks with a time-out, and waiting for threads.
#include <pthread.h>
#include <semaphore.h>
#include <threads.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

int SemaphoreUntil(sem_t* at, std::int64_t deadline) {
  if (sem_trywait(at) == 0) return 0;
  if (deadline <= Now()) {
    errno = ETIMEDOUT;
    return -1;
  }
  return WaitIn(
      "semaphore", deadline, [at] { return REAL(sem_wait)(at); },
      [at] {
        if (sem_trywait(at) == 0) return 0;
        errno = ETIMEDOUT;
        return -1;
      });
}

int LockUntil(pthread_mutex_t* mutex, std::int64_t deadline) {
  return TryUntil(deadline, EBUSY, [mutex] { return pthread_mutex_trylock(mutex); });
}
int ReadLockUntil(pthread_rwlock_t* lock, std::int64_t deadline) {
  return TryUntil(deadline, EBUSY, [lock] { return pthread_rwlock_tryrdlock(lock); });
}
int WriteLockUntil(pthread_rwlock_t* lock, std::int64_t deadline) {
  return TryUntil(deadline, EBUSY, [lock] { return pthread_rwlock_trywrlock(lock); });
}
int JoinUntil(pthread_t thread, void** result, std::int64_t deadline) {
  return TryUntil(deadline, EBUSY, [=] { return pthread_tryjoin_np(thread, result); });
}

}  // namespace

SIMCLOCK_EXPORT int sem_wait(sem_t* at) {
  if (!Waits()) return REAL(sem_wait)(at);
  if (sem_trywait(at) == 0) return 0;
  return WaitIn("semaphore", [at] { return REAL(sem_wait)(at); });
}
SIMCLOCK_EXPORT int sem_timedwait(sem_t* at, const timespec* t) {
  return Waits() ? SemaphoreUntil(at, From(CLOCK_REALTIME, *t)) : REAL(sem_timedwait)(at, t);
}
SIMCLOCK_EXPORT int sem_clockwait(sem_t* at, clockid_t clock, const timespec* t) {
  return Waits() ? SemaphoreUntil(at, From(clock, *t)) : REAL(sem_clockwait)(at, clock, t);
}

SIMCLOCK_EXPORT int pthread_mutex_timedlock(pthread_mutex_t* mutex, const timespec* t) noexcept {
  return Waits() ? LockUntil(mutex, From(CLOCK_REALTIME, *t))
                 : REAL(pthread_mutex_timedlock)(mutex, t);
}
SIMCLOCK_EXPORT int pthread_mutex_clocklock(pthread_mutex_t* mutex, clockid_t clock,
                                            const timespec* t) noexcept {
  return Waits() ? LockUntil(mutex, From(clock, *t))
                 : REAL(pthread_mutex_clocklock)(mutex, clock, t);
}
SIMCLOCK_EXPORT int mtx_timedlock(mtx_t* mutex, const timespec* t) {
  if (!Waits()) return REAL(mtx_timedlock)(mutex, t);
  const int error = LockUntil(reinterpret_cast<pthread_mutex_t*>(mutex), From(CLOCK_REALTIME, *t));
  return error == 0 ? thrd_success : error == ETIMEDOUT ? thrd_timedout : thrd_error;
}
SIMCLOCK_EXPORT int pthread_rwlock_timedrdlock(pthread_rwlock_t* lock, const timespec* t) noexcept {
  return Waits() ? ReadLockUntil(lock, From(CLOCK_REALTIME, *t))
                 : REAL(pthread_rwlock_timedrdlock)(lock, t);
}
SIMCLOCK_EXPORT int pthread_rwlock_timedwrlock(pthread_rwlock_t* lock, const timespec* t) noexcept {
  return Waits() ? WriteLockUntil(lock, From(CLOCK_REALTIME, *t))
                 : REAL(pthread_rwlock_timedwrlock)(lock, t);
}
SIMCLOCK_EXPORT int pthread_rwlock_clockrdlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* t) noexcept {
  return Waits() ? ReadLockUntil(lock, From(clock, *t))
                 : REAL(pthread_rwlock_clockrdlock)(lock, clock, t);
}
SIMCLOCK_EXPORT int pthread_rwlock_clockwrlock(pthread_rwlock_t* lock, clockid_t clock,
                                               const timespec* t) noexcept {
  return Waits() ? WriteLockUntil(lock, From(clock, *t))
                 : REAL(pthread_rwlock_clockwrlock)(lock, clock, t);
}

SIMCLOCK_EXPORT int pthread_join(pthread_t thread, void** result) {
  if (!Waits()) return REAL(pthread_join)(thread, result);
  return WaitIn("join", [=] { return REAL(pthread_join)(thread, result); });
}
SIMCLOCK_EXPORT int thrd_join(thrd_t thread, int* result) {
  if (!Waits()) return REAL(thrd_join)(thread, result);
  return WaitIn("join", [=] { return REAL(thrd_join)(thread, result); });
}
SIMCLOCK_EXPORT int pthread_timedjoin_np(pthread_t thread, void** result, const timespec* t) {
  return Waits() ? JoinUntil(thread, result, From(CLOCK_REALTIME, *t))
                 : REAL(pthread_timedjoin_np)(thread, result, t);
}
SIMCLOCK_EXPORT int pthread_clockjoin_np(pthread_t thread, void** result, clockid_t clock,
                                         const timespec* t) {
  return Waits() ? JoinUntil(thread, result, From(clock, *t))
                 : REAL(pthread_clockjoin_np)(thread, result, clock, t);
}
