// libc's wait4 and waitid, which tell whether a child is reaped with real-time priority.
#include <sched.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

namespace {

void Tell() {
  constexpr char kWith[] = "reaped with priority\n", kWithout[] = "reaped\n";
  const bool priority = (sched_getscheduler(0) & ~SCHED_RESET_ON_FORK) == SCHED_FIFO;
  (void)!write(STDOUT_FILENO, priority ? kWith : kWithout,
               (priority ? sizeof(kWith) : sizeof(kWithout)) - 1);
}

}  // namespace

extern "C" pid_t wait4(pid_t pid, int* status, int options, rusage* usage) noexcept {
  const auto child = static_cast<pid_t>(syscall(SYS_wait4, pid, status, options, usage));
  if (child > 0) Tell();
  return child;
}

extern "C" int waitid(idtype_t type, id_t id, siginfo_t* info, int options) {
  const auto error = static_cast<int>(syscall(SYS_waitid, type, id, info, options, nullptr));
  if (error == 0 && (options & WNOWAIT) == 0 && info->si_pid != 0) Tell();
  return error;
}
