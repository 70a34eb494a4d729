// Threads and processes that begin, their signals and the core on which they run.
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include <fcntl.h>
#include <pthread.h>
#include <sched.h>
#include <spawn.h>
#include <sys/wait.h>
#include <threads.h>
#include <unistd.h>

#include "simclock/preload/core.h"

using namespace understudy::simclock;  // NOLINT(google-build-using-namespace)

namespace {

struct Beginning {
  void* (*routine)(void*);
  void* argument;
  Slot* slot;
};

void* Begin(void* at) {
  const Beginning beginning = *static_cast<Beginning*>(at);
  std::free(at);
  Adopt(beginning.slot);
  if (in_robot) AdoptCore();  // those of a program have it from their maker
  sigset_t ours;
  sigemptyset(&ours);
  sigaddset(&ours, page->signal);
  REAL(pthread_sigmask)(SIG_UNBLOCK, &ours, nullptr);
  return beginning.routine(beginning.argument);
}

int Create(pthread_t* thread, const pthread_attr_t* with, void* (*routine)(void*), void* argument) {
  auto* const beginning = static_cast<Beginning*>(std::malloc(sizeof(Beginning)));
  if (beginning == nullptr) return EAGAIN;
  Slot* const slot = TakeSlot();
  *beginning = {.routine = routine, .argument = argument, .slot = slot};
  const int error = REAL(pthread_create)(thread, with, &Begin, beginning);
  if (error == 0) return 0;
  FreeSlot(slot);
  std::free(beginning);
  return error;
}

// The first thread of a process that posix_spawn makes has a slot before this one goes on.
template <typename Spawn>
int Spawned(pid_t* pid, Spawn spawn) {
  Slot* const slot = Waits() ? TakeSlot() : nullptr;
  pid_t child = 0;
  const int error = spawn(&child);
  if (pid != nullptr) *pid = child;
  if (slot == nullptr) return error;
  if (error != 0 || child == 0) {
    FreeSlot(slot);
    return error;
  }
  for (std::uint32_t i = 0; i < page->used; ++i) {  // the child was faster
    if (page->slots[i].state == State::kFree || page->slots[i].pid != child) continue;
    FreeSlot(slot);
    return 0;
  }
  slot->tid = child;
  slot->pid = child;
  return 0;
}

// The last process that this thread has made; 0 if the kernel does not say.
pid_t LastChild() {
  char name[64];
  std::snprintf(name, sizeof(name), "/proc/self/task/%d/children", ThreadId());
  const int file = open(name, O_RDONLY | O_CLOEXEC);
  char text[4096];
  const ssize_t size = file < 0 ? 0 : REAL(read)(file, text, sizeof(text));
  if (file >= 0) REAL(close)(file);
  pid_t last = 0;
  for (ssize_t i = 0, number = 0; i < size; ++i) {
    if (text[i] < '0' || text[i] > '9') {
      last = static_cast<pid_t>(number);
      number = 0;
      while (i + 1 < size && text[i + 1] == ' ') ++i;
    } else {
      number = number * 10 + (text[i] - '0');
    }
  }
  return last;
}

const sigset_t* WithoutOurs(int how, const sigset_t* set, sigset_t* copy) {
  if (!Keeps() || set == nullptr || how == SIG_UNBLOCK) return set;
  *copy = *set;
  sigdelset(copy, page->signal);
  return copy;
}

}  // namespace

SIMCLOCK_EXPORT int pthread_create(pthread_t* thread, const pthread_attr_t* with,
                                   void* (*routine)(void*), void* argument) noexcept {
  return OnClock(CALLER) ? Create(thread, with, routine, argument)
                         : REAL(pthread_create)(thread, with, routine, argument);
}
SIMCLOCK_EXPORT int thrd_create(thrd_t* thread, thrd_start_t routine, void* argument) {
  if (!OnClock(CALLER)) return REAL(thrd_create)(thread, routine, argument);
  struct Routine {
    thrd_start_t routine;
    void* argument;
  };
  auto* const one = static_cast<Routine*>(std::malloc(sizeof(Routine)));
  if (one == nullptr) return thrd_nomem;
  *one = {.routine = routine, .argument = argument};
  const auto begin = [](void* at) {
    const Routine copy = *static_cast<Routine*>(at);
    std::free(at);
    return reinterpret_cast<void*>(static_cast<std::intptr_t>(copy.routine(copy.argument)));
  };
  if (Create(thread, nullptr, begin, one) == 0) return thrd_success;
  std::free(one);
  return thrd_error;
}

// In the robot's process the tick waits for Cyclone's collector of garbage where a reader goes, and
// time stands still then. It sends nothing.
SIMCLOCK_EXPORT int pthread_setname_np(pthread_t thread, const char* name) noexcept {
  const bool collector = page != nullptr && pthread_equal(thread, pthread_self()) != 0 &&
                         std::strcmp(name, "gc") == 0 && Waiter() != nullptr;
  if (collector && in_robot) LeaveClock();
  if (collector && !in_robot) Collect();
  return REAL(pthread_setname_np)(thread, name);
}

SIMCLOCK_EXPORT pid_t vfork() noexcept { return Keeps() ? fork() : REAL(fork)(); }
SIMCLOCK_EXPORT int posix_spawn(pid_t* pid, const char* path,
                                const posix_spawn_file_actions_t* actions,
                                const posix_spawnattr_t* with, char* const* arguments,
                                char* const* environment) {
  return Spawned(pid, [&](pid_t* child) {
    return REAL(posix_spawn)(child, path, actions, with, arguments, environment);
  });
}
SIMCLOCK_EXPORT int posix_spawnp(pid_t* pid, const char* file,
                                 const posix_spawn_file_actions_t* actions,
                                 const posix_spawnattr_t* with, char* const* arguments,
                                 char* const* environment) {
  return Spawned(pid, [&](pid_t* child) {
    return REAL(posix_spawnp)(child, file, actions, with, arguments, environment);
  });
}
SIMCLOCK_EXPORT FILE* popen(const char* command, const char* mode) {
  FILE* file = nullptr;
  Spawned(nullptr, [&](pid_t* child) {
    file = REAL(popen)(command, mode);
    if (file != nullptr && Keeps()) *child = LastChild();
    return file != nullptr ? 0 : errno;
  });
  return file;
}
// As libc's, which starts the shell by a call that the library does not see.
SIMCLOCK_EXPORT int system(const char* command) {
  if (command == nullptr || !Keeps()) return REAL(system)(command);
  struct sigaction ignored {
  }, interrupt{}, quit{};
  ignored.sa_handler = SIG_IGN;
  REAL(sigaction)(SIGINT, &ignored, &interrupt);
  REAL(sigaction)(SIGQUIT, &ignored, &quit);
  int status = -1;
  const pid_t child = fork();
  if (child == 0) {
    REAL(sigaction)(SIGINT, &interrupt, nullptr);
    REAL(sigaction)(SIGQUIT, &quit, nullptr);
    execl("/bin/sh", "sh", "-c", command, nullptr);
    _exit(127);
  }
  while (child > 0 && waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  REAL(sigaction)(SIGINT, &interrupt, nullptr);
  REAL(sigaction)(SIGQUIT, &quit, nullptr);
  return status;
}

SIMCLOCK_EXPORT int sched_setscheduler(pid_t pid, int policy, const sched_param* p) noexcept {
  return Keeps() ? 0 : REAL(sched_setscheduler)(pid, policy, p);
}
SIMCLOCK_EXPORT int sched_setparam(pid_t pid, const sched_param* p) noexcept {
  return Keeps() ? 0 : REAL(sched_setparam)(pid, p);
}
SIMCLOCK_EXPORT int pthread_setschedparam(pthread_t thread, int policy,
                                          const sched_param* p) noexcept {
  return Keeps() ? 0 : REAL(pthread_setschedparam)(thread, policy, p);
}
SIMCLOCK_EXPORT int pthread_attr_setinheritsched(pthread_attr_t* with, int inherit) noexcept {
  return REAL(pthread_attr_setinheritsched)(with, Keeps() ? PTHREAD_INHERIT_SCHED : inherit);
}
SIMCLOCK_EXPORT int sched_setaffinity(pid_t pid, size_t size, const cpu_set_t* set) noexcept {
  return Keeps() ? 0 : REAL(sched_setaffinity)(pid, size, set);
}
SIMCLOCK_EXPORT int pthread_setaffinity_np(pthread_t thread, size_t size,
                                           const cpu_set_t* set) noexcept {
  return Keeps() ? 0 : REAL(pthread_setaffinity_np)(thread, size, set);
}

SIMCLOCK_EXPORT int pthread_sigmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  sigset_t copy;
  return REAL(pthread_sigmask)(how, WithoutOurs(how, set, &copy), old);
}
SIMCLOCK_EXPORT int sigprocmask(int how, const sigset_t* set, sigset_t* old) noexcept {
  sigset_t copy;
  return REAL(sigprocmask)(how, WithoutOurs(how, set, &copy), old);
}
SIMCLOCK_EXPORT int sigaction(int signal, const struct sigaction* wanted,
                              struct sigaction* old) noexcept {
  const bool ours = Keeps() && signal == page->signal && wanted != nullptr;
  return ours ? 0 : REAL(sigaction)(signal, wanted, old);
}
