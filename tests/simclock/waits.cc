// waits NAME: waits a second in one way; exit code 0 if the program's own clock agrees within 2 ms.
// Without a name it prints all names.
#include <atomic>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>
#include <functional>
#include <future>
#include <map>
#include <mutex>
#include <semaphore>
#include <string>
#include <thread>

#include <arpa/inet.h>
#include <dlfcn.h>
#include <linux/futex.h>
#include <mqueue.h>
#include <poll.h>
#include <pthread.h>
#include <semaphore.h>
#include <sys/epoll.h>
#include <sys/select.h>
#include <sys/sem.h>
#include <sys/socket.h>
#include <sys/syscall.h>
#include <sys/time.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

namespace {

using namespace std::chrono_literals;  // NOLINT(google-build-using-namespace)

timespec In(clockid_t clock, double seconds) {
  timespec now{};
  clock_gettime(clock, &now);
  const auto ns =
      now.tv_sec * 1'000'000'000LL + now.tv_nsec + static_cast<long long>(seconds * 1e9);
  return {.tv_sec = ns / 1'000'000'000LL, .tv_nsec = ns % 1'000'000'000LL};
}

int Socket() {
  const int fd = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in at{};
  at.sin_family = AF_INET;
  at.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  bind(fd, reinterpret_cast<sockaddr*>(&at), sizeof(at));
  return fd;
}

void OnSignal(int signal) {
  std::signal(signal, [](int) {});
}

void WaitForCondition(clockid_t clock, bool clockwait) {
  pthread_condattr_t with;
  pthread_condattr_init(&with);
  if (!clockwait) pthread_condattr_setclock(&with, clock);
  pthread_cond_t condition;
  pthread_cond_init(&condition, &with);
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  const timespec until = In(clock, 1);
  int error = 0;
  while (error == 0) {
    error = clockwait ? pthread_cond_clockwait(&condition, &mutex, clock, &until)
                      : pthread_cond_timedwait(&condition, &mutex, &until);
  }
}

void WaitForTimer(int flags, double period) {
  const int fd = timerfd_create(CLOCK_MONOTONIC, 0);
  const timespec every = {.tv_sec = 0, .tv_nsec = static_cast<long>(period * 1e9)};
  const itimerspec wanted = {.it_interval = every,
                             .it_value = flags != 0   ? In(CLOCK_MONOTONIC, 1)
                                         : period > 0 ? every
                                                      : timespec{1, 0}};
  timerfd_settime(fd, flags, &wanted, nullptr);
  const std::uint64_t times = period > 0 ? static_cast<std::uint64_t>(1 / period) : 1;
  std::uint64_t ended = 0;
  for (std::uint64_t n = 0; ended < times && read(fd, &n, sizeof(n)) == sizeof(n);) ended += n;
}

void WaitForPosixTimer(int notify) {
  static std::binary_semaphore called(0);
  OnSignal(SIGUSR1);
  sigevent event{};
  event.sigev_notify = notify;
  event.sigev_signo = SIGUSR1;
  if (notify == SIGEV_THREAD) {
    event.sigev_notify_function = [](sigval) { called.release(); };
  }
  timer_t timer{};
  timer_create(CLOCK_MONOTONIC, &event, &timer);
  const itimerspec wanted = {.it_interval = {}, .it_value = {.tv_sec = 1, .tv_nsec = 0}};
  timer_settime(timer, 0, &wanted, nullptr);
  if (notify == SIGEV_THREAD) {
    called.acquire();
  } else {
    pause();
  }
  timer_delete(timer);
}

void LockFor(const std::function<void(pthread_mutex_t*)>& lock) {
  pthread_mutex_t mutex = PTHREAD_MUTEX_INITIALIZER;
  pthread_mutex_lock(&mutex);
  lock(&mutex);
}

void ReceiveDatagram() {
  const int to = Socket();
  sockaddr_in at{};
  socklen_t size = sizeof(at);
  getsockname(to, reinterpret_cast<sockaddr*>(&at), &size);
  std::thread sender([&at] {
    sleep(1);
    sendto(Socket(), "x", 1, 0, reinterpret_cast<sockaddr*>(&at), sizeof(at));
  });
  char byte = 0;
  recv(to, &byte, 1, 0);
  sender.join();
}

const std::map<std::string, std::function<void()>> kWaits = {
    {"nanosleep",
     [] {
       const timespec t{1, 0};
       nanosleep(&t, nullptr);
     }},
    {"clock_nanosleep",
     [] {
       const timespec t = In(CLOCK_MONOTONIC, 1);
       clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &t, nullptr);
     }},
    {"clock_nanosleep date",
     [] {
       const timespec t = In(CLOCK_REALTIME, 1);
       clock_nanosleep(CLOCK_REALTIME, TIMER_ABSTIME, &t, nullptr);
     }},
    {"usleep", [] { usleep(999'999); }},
    {"sleep", [] { sleep(1); }},
    {"thrd_sleep",
     [] {
       const timespec t{1, 0};
       thrd_sleep(&t, nullptr);
     }},
    {"select",
     [] {
       timeval t{1, 0};
       select(0, nullptr, nullptr, nullptr, &t);
     }},
    {"pselect",
     [] {
       const timespec t{1, 0};
       pselect(0, nullptr, nullptr, nullptr, &t, nullptr);
     }},
    {"poll",
     [] {
       pollfd one{Socket(), POLLIN, 0};
       poll(&one, 1, 1000);
     }},
    {"ppoll",
     [] {
       pollfd one{Socket(), POLLIN, 0};
       const timespec t{1, 0};
       ppoll(&one, 1, &t, nullptr);
     }},
    {"epoll_wait",
     [] {
       epoll_event event{};
       epoll_wait(epoll_create1(0), &event, 1, 1000);
     }},
    {"epoll_pwait",
     [] {
       epoll_event event{};
       epoll_pwait(epoll_create1(0), &event, 1, 1000, nullptr);
     }},
    {"epoll_pwait2",
     [] {
       epoll_event event{};
       const timespec t{1, 0};
       epoll_pwait2(epoll_create1(0), &event, 1, &t, nullptr);
     }},
    {"SO_RCVTIMEO",
     [] {
       const int fd = Socket();
       const timeval t{1, 0};
       setsockopt(fd, SOL_SOCKET, SO_RCVTIMEO, &t, sizeof(t));
       char byte = 0;
       recv(fd, &byte, 1, 0);
     }},
    {"pthread_cond_timedwait date", [] { WaitForCondition(CLOCK_REALTIME, false); }},
    {"pthread_cond_timedwait", [] { WaitForCondition(CLOCK_MONOTONIC, false); }},
    {"pthread_cond_clockwait", [] { WaitForCondition(CLOCK_MONOTONIC, true); }},
    {"cnd_timedwait",
     [] {
       cnd_t c;
       mtx_t m;
       cnd_init(&c);
       mtx_init(&m, mtx_plain);
       mtx_lock(&m);
       const timespec t = In(CLOCK_REALTIME, 1);
       while (cnd_timedwait(&c, &m, &t) == thrd_success) {
       }
     }},
    {"sem_timedwait",
     [] {
       sem_t s;
       sem_init(&s, 0, 0);
       const timespec t = In(CLOCK_REALTIME, 1);
       sem_timedwait(&s, &t);
     }},
    {"sem_clockwait",
     [] {
       sem_t s;
       sem_init(&s, 0, 0);
       const timespec t = In(CLOCK_MONOTONIC, 1);
       sem_clockwait(&s, CLOCK_MONOTONIC, &t);
     }},
    {"pthread_mutex_timedlock",
     [] {
       LockFor([](pthread_mutex_t* m) {
         const timespec t = In(CLOCK_REALTIME, 1);
         pthread_mutex_timedlock(m, &t);
       });
     }},
    {"pthread_mutex_clocklock",
     [] {
       LockFor([](pthread_mutex_t* m) {
         const timespec t = In(CLOCK_MONOTONIC, 1);
         pthread_mutex_clocklock(m, CLOCK_MONOTONIC, &t);
       });
     }},
    {"pthread_rwlock_timedwrlock",
     [] {
       pthread_rwlock_t l = PTHREAD_RWLOCK_INITIALIZER;
       pthread_rwlock_rdlock(&l);
       const timespec t = In(CLOCK_REALTIME, 1);
       pthread_rwlock_timedwrlock(&l, &t);
     }},
    {"sigtimedwait",
     [] {
       sigset_t s;
       sigemptyset(&s);
       sigaddset(&s, SIGUSR1);
       sigprocmask(SIG_BLOCK, &s, nullptr);
       const timespec t{1, 0};
       sigtimedwait(&s, nullptr, &t);
     }},
    {"semtimedop",
     [] {
       const int s = semget(IPC_PRIVATE, 1, 0600);
       sembuf one{0, -1, 0};
       const timespec t{1, 0};
       semtimedop(s, &one, 1, &t);
       semctl(s, 0, IPC_RMID);
     }},
    {"timerfd", [] { WaitForTimer(0, 0); }},
    {"timerfd at", [] { WaitForTimer(TFD_TIMER_ABSTIME, 0); }},
    {"timerfd each", [] { WaitForTimer(0, 0.01); }},
    {"timer_create signal", [] { WaitForPosixTimer(SIGEV_SIGNAL); }},
    {"timer_create thread", [] { WaitForPosixTimer(SIGEV_THREAD); }},
    {"setitimer",
     [] {
       OnSignal(SIGALRM);
       const itimerval t{{0, 0}, {1, 0}};
       setitimer(ITIMER_REAL, &t, nullptr);
       pause();
     }},
    {"alarm",
     [] {
       OnSignal(SIGALRM);
       alarm(1);
       pause();
     }},
    {"futex",
     [] {
       std::uint32_t word = 0;
       const timespec t{1, 0};
       syscall(SYS_futex, &word, FUTEX_WAIT_PRIVATE, 0, &t, nullptr, 0);
     }},
    {"futex bitset",
     [] {
       std::uint32_t word = 0;
       const timespec t = In(CLOCK_MONOTONIC, 1);
       syscall(SYS_futex, &word, FUTEX_WAIT_BITSET_PRIVATE, 0, &t, nullptr, FUTEX_BITSET_MATCH_ANY);
     }},
    {"std::this_thread::sleep_for", [] { std::this_thread::sleep_for(1s); }},
    {"std::condition_variable",
     [] {
       std::mutex m;
       std::condition_variable v;
       std::unique_lock l(m);
       v.wait_for(l, 1s, [] { return false; });
     }},
    {"std::future",
     [] {
       std::promise<int> p;
       p.get_future().wait_for(1s);
     }},
    {"std::timed_mutex",
     [] {
       std::timed_mutex m;
       m.lock();
       std::thread([&m] { (void)!m.try_lock_for(1s); }).join();
     }},
    {"std::counting_semaphore",
     [] {
       std::counting_semaphore<4> s(0);
       (void)!s.try_acquire_for(1s);
     }},
    {"a loop over the clock",
     [] {
       const auto end = std::chrono::steady_clock::now() + 1s;
       while (std::chrono::steady_clock::now() < end) {
       }
     }},
    {"another thread",
     [] {
       std::promise<void> p;
       std::thread t([&p] {
         sleep(1);
         p.set_value();
       });
       p.get_future().wait();
       t.join();
     }},
    {"a datagram", ReceiveDatagram},
    {"a child by fork",
     [] {
       if (fork() == 0) {
         sleep(1);
         _exit(0);
       }
       wait(nullptr);
     }},
    {"a child by system", [] { (void)!system("sleep 1"); }},
    {"a child by popen",
     [] {
       FILE* f = popen("sleep 1", "r");
       pclose(f);
     }},
};

}  // namespace

// Sleeps so that no preloaded library sees it, as programs do that ask the kernel by themselves.
void SleepUnseen() {
  void* const libc = dlopen("libc.so.6", RTLD_LAZY | RTLD_NOLOAD);
  const auto sleeps = reinterpret_cast<decltype(&nanosleep)>(dlsym(libc, "nanosleep"));
  const timespec time{.tv_sec = 0, .tv_nsec = 300'000'000};
  sleeps(&time, nullptr);
}

// Takes 5 ms of the processor from each sleep to the next message, and 60 ms from there to two
// more.
void Compute() {
  const auto used = [] {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return 1e-9 * static_cast<double>(time.tv_nsec) + static_cast<double>(time.tv_sec);
  };
  const auto compute = [&used](double seconds) {
    for (const double begun = used(); used() - begun < seconds;) {
    }
  };
  const auto send = [fd = Socket()] {
    sockaddr_in to{};
    to.sin_family = AF_INET;
    to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    to.sin_port = htons(9);
    sendto(fd, "x", 1, 0, reinterpret_cast<sockaddr*>(&to), sizeof(to));
  };
  for (int i = 0; i < 5; ++i) {
    std::this_thread::sleep_for(10ms);
    compute(0.005);
    send();
    compute(0.06);
    send();
    send();
  }
}

int main(int argc, char** argv) {
  if (argc < 2) {
    for (const auto& [name, wait] : kWaits) std::puts(name.c_str());
    return 0;
  }
  if (std::string(argv[1]) == "unseen") {  // not among the names: the clock does not end it
    SleepUnseen();
    return 0;
  }
  if (std::string(argv[1]) == "computes") {
    Compute();
    return 0;
  }
  const auto begun = std::chrono::steady_clock::now();
  kWaits.at(argv[1])();
  const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begun;
  std::printf("%.6f\n", took.count());
  return std::abs(took.count() - 1) < 0.002 ? 0 : 1;
}
