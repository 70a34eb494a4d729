// Forks the command of `understudy exec` early and starts it when the robot is ready.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "base/unique_fd.h"
#include "exec/capabilities.h"
#include "exec/command.h"

namespace understudy::exec {

// A child process, forked by the constructor, that waits and becomes the command at Release().
// Between it and us is a keeper, a process that ends what the command has started. The command
// therefore inherits nothing that this process changes in between: threads, signal handlers and
// masks, real-time priority, locked memory. It shares stdin, stdout, stderr and all other
// descriptors that are not close-on-exec.
//
// Signals: the command stays in our process group. Ctrl-C, Ctrl-\ and Ctrl-Z reach it and its
// children, it may read the terminal, and a signal to the group (from timeout(1), a shell's job
// control, a CI runner) reaches all. So do not forward a SIGINT or SIGQUIT of the terminal (siginfo
// si_code SI_KERNEL), only one sent to our pid. Terminate() and Forward() signal only the command,
// not its children.
//
// When the command has ended, what it started and left, at any depth, is ended: by SIGTERM, after
// 0.3 s by SIGKILL. Only then has the child ended. If our process or the constructing thread ends
// in any way, even by kill -9, the command and what it started are killed at once (a set-uid
// program is not).
class ChildProcess {
 public:
  using Environment = std::vector<std::pair<std::string, std::string>>;  // name, value

  // Forks. `arguments[0]` is searched in the PATH of the command's environment, which is ours with
  // `additions`; these replace variables of the same name.
  //
  // Call it in the main thread, after EnterPrivateNetwork(), before other threads exist and before
  // signals are handled, blocked or ignored: the command inherits the mask and the ignored signals.
  // If SIGCHLD is ignored, it is reset to default in this process and the command, since the
  // kernel would discard exit codes otherwise.
  //
  // With `standard_error` or `standard_output`, a descriptor, the command has that for its stderr
  // or stdout instead of ours. With `rights` it has those instead of ours, which have to include
  // them: of CabledNetwork.
  //
  // Throws CommandError: no such program (127), not executable (126), fork failed (125).
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        const Environment& additions = {}, int standard_error = -1,
                        int standard_output = -1, const Capabilities* rights = nullptr);

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // Kills a running command; a command that was never released does not run.
  ~ChildProcess();

  // Starts the command and waits until exec has succeeded, some milliseconds. It also returns if a
  // signal has ended the waiting child; Poll() reports that. A second call does nothing. Throws
  // CommandError if the kernel refuses the file (126; a missing interpreter: 127); Poll() then
  // returns the same code.
  void Release();

  // Returns the exit code of the child, 128 + n if signal n ended it, nullopt while it runs. Does
  // not block and makes one system call. Sends the SIGKILL of Terminate() when it is due.
  std::optional<int> Poll();

  // Ends the child: sends SIGTERM now (and SIGCONT in case it is stopped), and SIGKILL in the first
  // Poll() after `grace`. Returns immediately, so the robot keeps running while the command shuts
  // down.
  void Terminate(std::chrono::milliseconds grace);

  // Sends a signal to the child; does nothing after Poll() has returned an exit code.
  void Forward(int signal);

  // Blocks until the child ends and returns what Poll() returns. Never returns if the child is
  // neither released nor terminated.
  int Wait();

 private:
  std::string program_;
  UniqueFd gate_;   // sends one byte: start; receives errno of exec, or end of file: exec succeeded
  pid_t pid_ = -1;  // of the keeper
  std::optional<int> exit_code_;
  std::optional<std::chrono::steady_clock::time_point> kill_at_;
};

}  // namespace understudy::exec
