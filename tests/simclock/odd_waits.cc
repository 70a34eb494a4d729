// A program that waits as `waits` does not: for a child (`reaps`), computing (`computes`), and in
// real time while the simulated stands (`stands`).
#include <cerrno>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <ctime>
#include <string_view>

#include <dlfcn.h>
#include <poll.h>
#include <sched.h>
#include <sys/timerfd.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

// Waits for children in each way; 1 if the thread does not get its priority back.
int Reap() {
  const int before = sched_getscheduler(0);
  const auto child = [] {
    const pid_t pid = fork();
    if (pid == 0) {
      sleep(1);
      _exit(7);
    }
    return pid;
  };
  int status = 0;
  siginfo_t info{};
  const pid_t one = child();
  if (waitpid(one, &status, 0) != one || WEXITSTATUS(status) != 7) return 2;
  if (waitid(P_PID, static_cast<id_t>(child()), &info, WEXITED) != 0 || info.si_status != 7) {
    return 3;
  }
  const pid_t polled = child();
  while (waitpid(polled, &status, WNOHANG) == 0) usleep(10'000);
  if (waitpid(-1, &status, 0) != -1 || errno != ECHILD) return 4;
  return sched_getscheduler(0) == before ? 0 : 1;
}

// Computes 3 s of the processor while it says that it waits: in a handler of signals.
void ComputeInWait() {
  signal(SIGUSR1, [](int) {
    timespec used{};
    while (used.tv_sec < 3) clock_gettime(CLOCK_THREAD_CPUTIME_ID, &used);
  });
  if (fork() == 0) {
    usleep(10'000);
    kill(getppid(), SIGUSR1);
    usleep(10'000);
    _exit(0);
  }
  poll(nullptr, 0, 1000);
}

double Now() {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

// Waits for 0.2 s of real time by a time-out and by a timer, while another process sleeps in
// simulated steps for 1 s; then waits for the end of that, by a call that the clock does not end.
int StandStill() {
  auto* const stand = reinterpret_cast<void (*)(bool)>(dlsym(RTLD_DEFAULT, "simclock_stand"));
  int ends[2];
  if (stand == nullptr || pipe(ends) != 0) return 2;
  if (fork() == 0) {
    for (int i = 0; i < 100; ++i) usleep(10'000);
    _exit(0);
  }
  usleep(5'000);
  const double before = Now();
  stand(true);
  const double begun = Now();
  poll(nullptr, 0, 100);
  const int timer = timerfd_create(CLOCK_MONOTONIC, 0);
  const itimerspec wanted{.it_interval = {}, .it_value = {.tv_sec = 0, .tv_nsec = 100'000'000}};
  timerfd_settime(timer, 0, &wanted, nullptr);
  std::uint64_t times = 0;
  if (read(timer, &times, sizeof(times)) != sizeof(times)) return 3;
  close(timer);
  const double waited = Now() - begun;
  stand(false);
  if (std::abs(Now() - before - 0.01) > 1e-6) return 4;  // what it costs to ask
  if (waited < 0.2 || waited > 20) return 5;
  close(ends[1]);
  char none = 0;
  if (read(ends[0], &none, 1) != 0) return 6;
  return Now() > 0.9 + before && Now() < 1.1 + before ? 0 : 7;
}

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted(argc > 1 ? argv[1] : "");
  if (wanted == "reaps") return Reap();
  if (wanted == "stands") return StandStill();
  if (wanted != "computes") return 2;
  ComputeInWait();
  return 0;
}
