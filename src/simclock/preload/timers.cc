// Timers. A thread of ours in each process that has some ends them: by adding to an eventfd, which
// a timerfd is here, or by a signal, as timer_create(2), setitimer(2) and alarm(2) have it.
#include <array>
#include <csignal>
#include <cstring>

#include <linux/futex.h>
#include <pthread.h>
#include <sys/eventfd.h>
#include <sys/syscall.h>
#include <sys/timerfd.h>
#include <unistd.h>

#include "simclock/preload/core.h"
#include "simclock/preload/descriptors.h"

namespace understudy::simclock {
namespace {

struct Timer {
  bool used = false;
  int fd = -1;       // of a timerfd
  sigevent event{};  // of another
  clockid_t clock = CLOCK_MONOTONIC;
  std::int64_t deadline = kNever;  // ns
  std::int64_t interval = 0;       // ns, 0: once
};
constexpr std::size_t kMostTimers = 128;  // *assumed*
std::array<Timer, kMostTimers> timers;    // the first is that of setitimer
pthread_mutex_t lock = PTHREAD_MUTEX_INITIALIZER;
std::atomic<std::uint32_t> changes;  // a futex
int thread_of = 0;                   // the process whose thread ends the timers

class Locked {
 public:
  Locked() { pthread_mutex_lock(&lock); }
  ~Locked() { pthread_mutex_unlock(&lock); }
  Locked(const Locked&) = delete;
  Locked& operator=(const Locked&) = delete;
};

void Signal(const sigevent& event) {
  siginfo_t info{};
  info.si_signo = event.sigev_signo;
  info.si_code = SI_TIMER;
  info.si_value = event.sigev_value;
  if (event.sigev_notify == SIGEV_THREAD_ID) {
    REAL(syscall)(SYS_rt_tgsigqueueinfo, getpid(), event._sigev_un._tid, event.sigev_signo, &info);
  } else {
    REAL(syscall)(SYS_rt_sigqueueinfo, getpid(), event.sigev_signo, &info);
  }
}

void* Call(void* timer) {
  const sigevent event = static_cast<Timer*>(timer)->event;
  event._sigev_un._sigev_thread._function(event.sigev_value);
  return nullptr;
}

void End(Timer* timer, std::int64_t now) {
  std::uint64_t times = 1;
  if (timer->interval > 0) {
    times += static_cast<std::uint64_t>((now - timer->deadline) / timer->interval);
    timer->deadline += static_cast<std::int64_t>(times) * timer->interval;
  } else {
    timer->deadline = kNever;
  }
  if (timer->fd >= 0) {
    [[maybe_unused]] const ssize_t ignored = ::write(timer->fd, &times, sizeof(times));
  } else if (timer->event.sigev_notify == SIGEV_THREAD) {
    pthread_t thread{};
    if (pthread_create(&thread, nullptr, &Call, timer) == 0) pthread_detach(thread);
  } else if (timer->event.sigev_notify != SIGEV_NONE) {
    Signal(timer->event);
  }
}

void* EndTimers(void*) {
  pthread_setname_np(pthread_self(), "simclock timers");
  for (;;) {
    const std::uint32_t seen = changes;
    std::int64_t earliest = kNever;
    {
      const Locked locked;
      for (Timer& timer : timers) {
        if (timer.used && timer.deadline <= Now()) End(&timer, Now());
        if (timer.used && timer.deadline < earliest) earliest = timer.deadline;
      }
    }
    FutexWait(&changes, seen, FUTEX_BITSET_MATCH_ANY, true, earliest, "timers");
  }
  return nullptr;
}

// With the lock held.
void Set(Timer* timer, bool absolute, const itimerspec& wanted) {
  const std::int64_t value = Ns(wanted.it_value);
  timer->interval = Ns(wanted.it_interval);
  timer->deadline = value == 0 ? kNever
                    : absolute ? From(timer->clock, wanted.it_value)
                               : After(value);
  changes.fetch_add(1);
  Futex(&changes, FUTEX_WAKE_PRIVATE, 1);
  if (thread_of == getpid()) return;
  thread_of = getpid();
  sigset_t all, before;
  sigfillset(&all);
  sigdelset(&all, page->signal);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  pthread_t thread{};
  if (pthread_create(&thread, nullptr, &EndTimers, nullptr) == 0) pthread_detach(thread);
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
}

itimerspec Get(const Timer& timer) {
  if (timer.deadline == kNever) return {.it_interval = Spec(timer.interval), .it_value = {}};
  const std::int64_t left = timer.deadline - Now();
  return {.it_interval = Spec(timer.interval), .it_value = Spec(left > 0 ? left : 1)};
}

Timer* Find(int fd) {
  for (Timer& timer : timers) {
    if (timer.used && timer.fd == fd) return &timer;
  }
  return nullptr;
}

Timer* Make() {
  for (std::size_t i = 1; i < timers.size(); ++i) {
    if (timers[i].used) continue;
    timers[i] = {};
    timers[i].used = true;
    return &timers[i];
  }
  return nullptr;
}

// The place of a timer_t of ours, which is its number.
Timer* Of(timer_t id) {
  const auto number = reinterpret_cast<std::uintptr_t>(id);
  if (number > 0 && number < timers.size() && timers[number].used) return &timers[number];
  errno = EINVAL;
  return nullptr;
}

}  // namespace

void DropTimer(int fd) {
  const Locked locked;
  Of(fd)->timer = 0;
  if (Timer* const timer = Find(fd)) timer->used = false;
}

}  // namespace understudy::simclock

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

SIMCLOCK_EXPORT int timerfd_create(int clock, int flags) noexcept {
  if (!HasTimers()) return REAL(timerfd_create)(clock, flags);
  const int fd = ::eventfd(0, ((flags & TFD_CLOEXEC) != 0 ? EFD_CLOEXEC : 0) |
                                  ((flags & TFD_NONBLOCK) != 0 ? EFD_NONBLOCK : 0));
  if (fd < 0) return -1;
  const Locked locked;
  Timer* const timer = Of(fd) != nullptr ? Make() : nullptr;
  if (timer == nullptr) {
    REAL(close)(fd);
    errno = EMFILE;
    return -1;
  }
  timer->fd = fd;
  timer->clock = clock;
  Of(fd)->timer = 1 + clock;
  return fd;
}
SIMCLOCK_EXPORT int timerfd_settime(int fd, int flags, const itimerspec* wanted,
                                    itimerspec* old) noexcept {
  if (!HasTimers()) return REAL(timerfd_settime)(fd, flags, wanted, old);
  const Locked locked;
  Timer* const timer = Find(fd);
  if (timer == nullptr) {
    errno = EINVAL;
    return -1;
  }
  if (old != nullptr) *old = Get(*timer);
  pollfd ready{.fd = fd, .events = POLLIN, .revents = 0};
  std::uint64_t expired = 0;  // before, and never read
  constexpr timespec kAtOnce{};
  if (REAL(ppoll)(&ready, 1, &kAtOnce, nullptr) > 0) REAL(read)(fd, &expired, sizeof(expired));
  Set(timer, (flags & TFD_TIMER_ABSTIME) != 0, *wanted);
  return 0;
}
SIMCLOCK_EXPORT int timerfd_gettime(int fd, itimerspec* now) noexcept {
  if (!HasTimers()) return REAL(timerfd_gettime)(fd, now);
  const Locked locked;
  const Timer* const timer = Find(fd);
  if (timer == nullptr) {
    errno = EINVAL;
    return -1;
  }
  *now = Get(*timer);
  return 0;
}

SIMCLOCK_EXPORT int timer_create(clockid_t clock, sigevent* event, timer_t* id) noexcept {
  if (!HasTimers() || !IsSimulated(clock)) {
    return REAL(timer_create)(clock, event, id);
  }
  const Locked locked;
  Timer* const timer = Make();
  if (timer == nullptr) {
    errno = EAGAIN;
    return -1;
  }
  const auto number = static_cast<std::uintptr_t>(timer - timers.data());
  *id = reinterpret_cast<timer_t>(number);
  timer->clock = clock;
  if (event != nullptr) {
    timer->event = *event;
  } else {
    timer->event.sigev_signo = SIGALRM;
    timer->event.sigev_value.sival_ptr = *id;
  }
  return 0;
}
SIMCLOCK_EXPORT int timer_settime(timer_t id, int flags, const itimerspec* wanted,
                                  itimerspec* old) noexcept {
  if (!HasTimers()) return REAL(timer_settime)(id, flags, wanted, old);
  const Locked locked;
  Timer* const timer = Of(id);
  if (timer == nullptr) return -1;
  if (old != nullptr) *old = Get(*timer);
  Set(timer, (flags & TIMER_ABSTIME) != 0, *wanted);
  return 0;
}
SIMCLOCK_EXPORT int timer_gettime(timer_t id, itimerspec* now) noexcept {
  if (!HasTimers()) return REAL(timer_gettime)(id, now);
  const Locked locked;
  const Timer* const timer = Of(id);
  if (timer == nullptr) return -1;
  *now = Get(*timer);
  return 0;
}
SIMCLOCK_EXPORT int timer_getoverrun(timer_t id) noexcept {
  return HasTimers() ? 0 : REAL(timer_getoverrun)(id);
}
SIMCLOCK_EXPORT int timer_delete(timer_t id) noexcept {
  if (!HasTimers()) return REAL(timer_delete)(id);
  const Locked locked;
  Timer* const timer = Of(id);
  if (timer == nullptr) return -1;
  timer->used = false;
  return 0;
}

SIMCLOCK_EXPORT int getitimer(__itimer_which_t which, itimerval* now) noexcept {
  if (!HasTimers() || which != ITIMER_REAL) return REAL(getitimer)(which, now);
  const Locked locked;
  const itimerspec left = Get(timers[0]);
  *now = {.it_interval = Micros(Ns(left.it_interval)), .it_value = Micros(Ns(left.it_value))};
  return 0;
}
SIMCLOCK_EXPORT int setitimer(__itimer_which_t which, const itimerval* wanted,
                              itimerval* old) noexcept {
  if (!HasTimers() || which != ITIMER_REAL) {
    return REAL(setitimer)(which, wanted, old);
  }
  if (old != nullptr) getitimer(which, old);
  const Locked locked;
  timers[0].used = true;
  timers[0].event.sigev_signo = SIGALRM;
  Set(&timers[0], false,
      {.it_interval = Spec(Ns(wanted->it_interval)), .it_value = Spec(Ns(wanted->it_value))});
  return 0;
}
SIMCLOCK_EXPORT unsigned alarm(unsigned seconds) noexcept {
  if (!HasTimers()) return REAL(alarm)(seconds);
  const itimerval wanted{.it_interval = {}, .it_value = {static_cast<time_t>(seconds), 0}};
  itimerval old{};
  setitimer(ITIMER_REAL, &wanted, &old);
  return static_cast<unsigned>(old.it_value.tv_sec + (old.it_value.tv_usec > 0 ? 1 : 0));
}
SIMCLOCK_EXPORT useconds_t ualarm(useconds_t us, useconds_t interval) noexcept {
  if (!HasTimers()) return REAL(ualarm)(us, interval);
  const itimerval wanted{.it_interval = Micros(interval * std::int64_t{1000}),
                         .it_value = Micros(us * std::int64_t{1000})};
  itimerval old{};
  setitimer(ITIMER_REAL, &wanted, &old);
  return static_cast<useconds_t>(Ns(old.it_value) / 1000);
}
