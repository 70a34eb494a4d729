#include "exec/child_process.h"

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <ctime>
#include <string_view>
#include <system_error>
#include <thread>

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

namespace understudy::exec {
namespace {

constexpr std::string_view kDefaultPath = "/bin:/usr/bin";  // of execvp(3) without PATH
constexpr std::chrono::milliseconds kWaitStep{2};  // assumed; bounds how late Wait() returns
// Both assumed: from SIGTERM to SIGKILL of what a command left, and from there on.
constexpr std::chrono::milliseconds kRestGrace{300}, kGivenUp{1000};

int CodeOf(int status) {
  return WIFSIGNALED(status) ? 128 + WTERMSIG(status) : WEXITSTATUS(status);
}

std::string_view NameOf(std::string_view entry) { return entry.substr(0, entry.find('=')); }

std::vector<std::string> MergedEnvironment(const ChildProcess::Environment& additions) {
  std::vector<std::string> merged;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    const bool replaced = std::any_of(additions.begin(), additions.end(), [&](const auto& added) {
      return added.first == NameOf(*entry);
    });
    if (!replaced) merged.emplace_back(*entry);
  }
  for (const auto& [name, value] : additions) {
    merged.emplace_back(name).append("=").append(value);
  }
  return merged;
}

std::string SearchPath(const std::vector<std::string>& environment) {
  for (const std::string& entry : environment) {
    if (NameOf(entry) == "PATH") return entry.substr(std::string_view("PATH=").size());
  }
  return std::string(kDefaultPath);
}

// The array for exec(2): pointers into `strings`, which must outlive it, and a null.
std::vector<char*> PointersTo(std::vector<std::string>& strings) {
  std::vector<char*> pointers;
  pointers.reserve(strings.size() + 1);
  for (std::string& text : strings) pointers.push_back(text.data());
  pointers.push_back(nullptr);
  return pointers;
}

void SetToDefault(int signal) {
  struct sigaction action {};
  action.sa_handler = SIG_DFL;
  ::sigaction(signal, &action, nullptr);
}

// Resets signal handlers, as exec would, before the child waits: ours must not run in the child.
void ResetHandlers() {
  for (int signal = 1; signal < NSIG; ++signal) {
    struct sigaction action {};
    if (::sigaction(signal, nullptr, &action) == 0 && action.sa_handler != SIG_DFL &&
        action.sa_handler != SIG_IGN) {
      SetToDefault(signal);
    }
  }
}

bool IgnoresChildren() {
  struct sigaction action {};
  return ::sigaction(SIGCHLD, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

[[noreturn]] void RefuseProcess(int error) {
  throw CommandError("cannot start a process: " + std::generic_category().message(error),
                     kExitOwnFailure);
}

// Reads exactly `size` bytes. Returns false at end of file or error.
bool ReadFully(int fd, void* buffer, std::size_t size) {
  auto* next = static_cast<char*>(buffer);
  while (size > 0) {
    const ssize_t got = ::read(fd, next, size);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    next += got;
    size -= static_cast<std::size_t>(got);
  }
  return true;
}

// What the two processes behind a ChildProcess need. They call only async-signal-safe functions.
struct Start {
  int gate;
  pid_t parent;
  sigset_t mask;  // of the command
  int standard_error, standard_output;
  const Capabilities* rights;
  const char* program;
  char* const* arguments;
  char* const* environment;
};

// Real-time signals to the keeper, which no program sends by chance.
int EndNow() { return SIGRTMIN; }
int ParentDied() { return SIGRTMIN + 1; }

[[noreturn]] void RefuseAtGate(int gate, int error, int code) {
  ::send(gate, &error, sizeof(error), MSG_NOSIGNAL);
  ::_exit(code);
}

// Runs the command from fork to exec. It starts with all signals blocked.
[[noreturn]] void WaitAndExec(const Start& start, pid_t keeper) {
  ::sigprocmask(SIG_SETMASK, &start.mask, nullptr);
  // The keeper may have died before prctl took effect; getppid() detects that.
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || ::getppid() != keeper) ::_exit(kExitOwnFailure);
  if (start.standard_error >= 0 && ::dup2(start.standard_error, STDERR_FILENO) < 0) {
    ::_exit(kExitOwnFailure);
  }
  if (start.standard_output >= 0 && ::dup2(start.standard_output, STDOUT_FILENO) < 0) {
    ::_exit(kExitOwnFailure);
  }
  char go = 0;
  if (!ReadFully(start.gate, &go, 1)) ::_exit(kExitOwnFailure);

  // `program` has a slash, so execvpe does not search again; it does run a script without #! by the
  // shell.
  ::execvpe(start.program, start.arguments, start.environment);
  RefuseAtGate(start.gate, errno, ExitCodeOfFailedExec(errno));
}

// Sends a signal to each child of this process.
void SignalChildren(int signal) {
  const UniqueFd list(::open("/proc/thread-self/children", O_RDONLY | O_CLOEXEC));
  std::array<char, 4096> text{};
  const ssize_t size = list.valid() ? ::read(list.get(), text.data(), text.size()) : 0;
  pid_t pid = 0;
  for (ssize_t i = 0; i < size; ++i) {
    const char c = text[static_cast<std::size_t>(i)];
    if (c >= '0' && c <= '9') {
      pid = pid * 10 + (c - '0');
      continue;
    }
    if (pid > 0) ::kill(pid, signal);
    pid = 0;
  }
}

// Ends the descendants that are left: by SIGTERM, and after `grace` by SIGKILL. Gives up those that
// do not end by that either, as of another user.
void EndRest(std::chrono::milliseconds grace) {
  const auto begun = std::chrono::steady_clock::now();
  const auto over = [begun](std::chrono::milliseconds since) {
    return std::chrono::steady_clock::now() >= begun + since;
  };
  for (bool asked = false; !over(grace + kGivenUp); asked = true) {
    pid_t ended = 0;
    do {
      ended = ::waitpid(-1, nullptr, WNOHANG);
    } while (ended > 0);
    if (ended < 0 && errno == ECHILD) return;
    if (over(grace)) {
      SignalChildren(SIGKILL);
    } else if (!asked) {
      SignalChildren(SIGTERM);
      SignalChildren(SIGCONT);
    }
    const timespec step{.tv_sec = 0, .tv_nsec = std::chrono::nanoseconds(kWaitStep).count()};
    ::nanosleep(&step, nullptr);
  }
}

// Runs the keeper: forks the command, passes the parent's signals on to it, and ends with its exit
// code when nothing that it started is left. It starts with all signals blocked.
[[noreturn]] void Keep(const Start& start) {
  ResetHandlers();
  SetToDefault(SIGCHLD);
  // Before prctl: a change of rights may clear what that sets.
  if (start.rights != nullptr && !start.rights->Apply()) ::_exit(kExitOwnFailure);
  // Orphans of the command become children of this process.
  if (::prctl(PR_SET_CHILD_SUBREAPER, 1) != 0 || ::prctl(PR_SET_PDEATHSIG, ParentDied()) != 0 ||
      ::getppid() != start.parent) {
    ::_exit(kExitOwnFailure);
  }
  const pid_t keeper = ::getpid();
  const pid_t command = ::fork();
  if (command == 0) WaitAndExec(start, keeper);
  if (command < 0) RefuseAtGate(start.gate, errno, kExitOwnFailure);
  ::close_range(STDERR_FILENO + 1, ~0U, 0);
  sigset_t all;
  ::sigfillset(&all);
  while (true) {
    siginfo_t told{};
    const int signal = ::sigwaitinfo(&all, &told);
    if (signal == ParentDied()) {
      EndRest({});
      ::_exit(kExitOwnFailure);
    }
    // Those of the terminal and of others to the group have reached the command, too.
    const bool of_parent = told.si_code <= 0 && told.si_pid == start.parent;
    if (signal > 0 && signal != SIGCHLD && of_parent) {
      ::kill(command, signal == EndNow() ? SIGKILL : signal);
    }
    int status = 0;
    for (pid_t ended = 0; (ended = ::waitpid(-1, &status, WNOHANG)) > 0;) {
      if (ended != command) continue;
      EndRest(kRestGrace);
      ::_exit(CodeOf(status));
    }
  }
}

}  // namespace

ChildProcess::ChildProcess(const std::vector<std::string>& arguments, const Environment& additions,
                           int standard_error, int standard_output, const Capabilities* rights) {
  if (arguments.empty()) throw CommandError("no command to run", kExitOwnFailure);
  std::vector<std::string> argument_texts = arguments;
  std::vector<std::string> environment_texts = MergedEnvironment(additions);
  program_ = FindProgram(arguments[0], SearchPath(environment_texts));
  const std::vector<char*> argument_pointers = PointersTo(argument_texts);
  const std::vector<char*> environment_pointers = PointersTo(environment_texts);

  std::array<int, 2> ends{};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()) != 0) {
    RefuseProcess(errno);
  }
  gate_ = UniqueFd(ends[0]);
  UniqueFd child_gate(ends[1]);

  // Blocks signals across the fork, as our handlers would consume those that arrive before the
  // reset.
  sigset_t all;
  sigset_t mask;
  ::sigfillset(&all);
  ::sigprocmask(SIG_SETMASK, &all, &mask);
  const Start start{.gate = child_gate.get(),
                    .parent = ::getpid(),
                    .mask = mask,
                    .standard_error = standard_error,
                    .standard_output = standard_output,
                    .rights = rights,
                    .program = program_.c_str(),
                    .arguments = argument_pointers.data(),
                    .environment = environment_pointers.data()};
  pid_ = ::fork();
  const int error = errno;
  if (pid_ == 0) {
    gate_.reset();  // else the child would not see our end close
    Keep(start);
  }
  ::sigprocmask(SIG_SETMASK, &mask, nullptr);
  if (pid_ < 0) RefuseProcess(error);
  if (IgnoresChildren()) SetToDefault(SIGCHLD);
}

ChildProcess::~ChildProcess() {
  gate_.reset();
  if (Poll()) return;
  Forward(SIGKILL);
  Wait();
}

void ChildProcess::Release() {
  if (!gate_.valid()) return;
  const UniqueFd gate = std::move(gate_);
  const char go = 1;
  // Ignores errors and SIGPIPE: Poll() reports a child that a signal has ended.
  ::send(gate.get(), &go, sizeof(go), MSG_NOSIGNAL);
  int error = 0;
  if (!ReadFully(gate.get(), &error, sizeof(error))) return;
  std::string what = "cannot run " + program_ + ": " + std::generic_category().message(error);
  if (error == ENOENT) what += " (the file is there, the interpreter it asks for is not)";
  throw CommandError(what, ExitCodeOfFailedExec(error));
}

std::optional<int> ChildProcess::Poll() {
  if (exit_code_) return exit_code_;
  int status = 0;
  const pid_t ended = ::waitpid(pid_, &status, WNOHANG);
  if (ended == pid_) {
    exit_code_ = CodeOf(status);
  } else if (ended < 0 && errno == ECHILD) {
    exit_code_ = kExitOwnFailure;  // other code has waited for it: its exit code is lost
  } else if (kill_at_ && std::chrono::steady_clock::now() >= *kill_at_) {
    Forward(SIGKILL);
  }
  return exit_code_;
}

void ChildProcess::Terminate(std::chrono::milliseconds grace) {
  kill_at_ = std::chrono::steady_clock::now() + grace;
  Forward(SIGTERM);
  Forward(SIGCONT);
}

void ChildProcess::Forward(int signal) {
  // The keeper is not reaped, so the pid cannot belong to another process.
  if (!exit_code_) ::kill(pid_, signal == SIGKILL ? EndNow() : signal);
}

int ChildProcess::Wait() {
  while (!Poll()) std::this_thread::sleep_for(kWaitStep);
  return *exit_code_;
}

}  // namespace understudy::exec
