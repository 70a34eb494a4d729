// Waiting for children.
#include <csignal>

#include <sys/resource.h>
#include <sys/wait.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

// Linux removes the child's folder in /proc where it is reaped, and spins there for as long as
// another uses it. With real-time priority the other, on the same core, would never get on.
template <typename Call>
auto Reap(Call call) -> decltype(call()) {
  const bool lower = page != nullptr && !in_robot && page->fifo != 0;
  if (lower) LeavePriority();
  const auto result = call();
  const int error = errno;
  if (lower) TakePriority();
  errno = error;
  return result;
}

// Waits until a child has changed, which the next wait reports; below 0 with errno else.
int WaitForChild(idtype_t type, id_t id, int options) {
  return WaitIn("waitpid", [=] {
    siginfo_t unused;
    return REAL(waitid)(type, id, &unused, options | WNOWAIT);
  });
}

int WaitForChild(pid_t pid, int options) {
  const idtype_t type = pid > 0 ? P_PID : pid == -1 ? P_ALL : P_PGID;
  return WaitForChild(type, static_cast<id_t>(pid < 0 ? -pid : pid), options | WEXITED);
}

}  // namespace

SIMCLOCK_EXPORT pid_t wait4(pid_t pid, int* status, int options, rusage* usage) noexcept {
  const bool waits = (options & WNOHANG) == 0 && Waits();
  for (;;) {
    if (waits && WaitForChild(pid, options) != 0) return -1;
    const int how = options | (waits ? WNOHANG : 0);
    const pid_t child = Reap([=] { return REAL(wait4)(pid, status, how, usage); });
    if (child != 0 || !waits) return child;  // else another thread was faster
  }
}
SIMCLOCK_EXPORT pid_t wait3(int* status, int options, rusage* usage) noexcept {
  return wait4(-1, status, options, usage);
}
SIMCLOCK_EXPORT pid_t waitpid(pid_t pid, int* status, int options) {
  return wait4(pid, status, options, nullptr);
}
SIMCLOCK_EXPORT pid_t wait(int* status) { return wait4(-1, status, 0, nullptr); }

SIMCLOCK_EXPORT int waitid(idtype_t type, id_t id, siginfo_t* info, int options) {
  const bool waits = (options & WNOHANG) == 0 && Waits();
  siginfo_t told{};
  siginfo_t* const to = info != nullptr ? info : &told;
  for (;;) {
    if (waits && WaitForChild(type, id, options) != 0) return -1;
    const int how = options | (waits ? WNOHANG : 0);
    const int error = Reap([=] { return REAL(waitid)(type, id, to, how); });
    if (error != 0 || !waits || to->si_pid != 0) return error;
  }
}
