// A program that waits as `waits` does not: for a child (`reaps`), and computing (`computes`).
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>

#include <poll.h>
#include <sched.h>
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

}  // namespace

int main(int argc, char** argv) {
  const std::string_view wanted(argc > 1 ? argv[1] : "");
  if (wanted == "reaps") return Reap();
  if (wanted != "computes") return 2;
  ComputeInWait();
  return 0;
}
