// Forks the program of `understudy exec` early and starts it when the robot is ready.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <sys/types.h>

#include "base/unique_fd.h"
#include "exec/command.h"

namespace understudy::exec {

// One child process. It waits behind a gate from construction on and becomes the command at
// Release(). It was forked early, so the command inherits nothing of what we do to ourselves in
// between: threads, signal handlers and masks, real-time priority, locked memory. It shares stdin,
// stdout and stderr with us, and all other descriptors that are not close-on-exec.
//
// Terminal: the command stays in our process group. So Ctrl-C, Ctrl-\ and Ctrl-Z reach it and
// everything it started, it may read the terminal, and whoever signals our group (timeout(1), a
// shell's job control, a CI runner) ends all of it. A SIGINT or SIGQUIT that the terminal sent
// (siginfo si_code SI_KERNEL) has thus reached the command already and is not to be forwarded; one
// sent to our pid is. Terminate() and Forward() reach the command alone, not what it started.
//
// Ends with us: should our process or the thread that constructed this end in any way, kill -9
// included, the kernel kills the command (not what it started, and not a set-uid program).
class ChildProcess {
 public:
  using Environment = std::vector<std::pair<std::string, std::string>>;  // name, value

  // Forks. `arguments[0]` is sought in the PATH of the command's environment, which is ours with
  // `additions` put in, replacing what has the same name.
  //
  // Call it in the main thread, after EnterPrivateNetwork(), while there is no other thread and
  // before signals are handled, blocked or ignored: mask and ignored signals are passed on as they
  // are here. Where SIGCHLD is ignored, it is set back to default here, not for the command: else
  // the kernel throws exit codes away.
  //
  // Throws CommandError: no such program (127), not executable (126), no process to be had (125).
  explicit ChildProcess(const std::vector<std::string>& arguments,
                        const Environment& additions = {});

  ChildProcess(const ChildProcess&) = delete;
  ChildProcess& operator=(const ChildProcess&) = delete;

  // A command still running is killed; one never released ends without having run.
  ~ChildProcess();

  // Opens the gate and waits until the command has been started, some milliseconds. If a signal
  // ended the child at the gate this returns too, and Poll() tells. A second call does nothing.
  // Throws CommandError when the kernel refuses the file (126; a missing interpreter: 127). Poll()
  // gives the same code.
  void Release();

  // Exit code of the child, 128 + n when signal n ended it; nothing while it lives. Does not block
  // and costs one system call. Sends the SIGKILL that Terminate() announced when it is due.
  std::optional<int> Poll();

  // Asks the child to end: SIGTERM now (and SIGCONT, should it be stopped), SIGKILL from the first
  // Poll() after `grace`. Returns at once, so that the robot goes on answering a program that stops
  // it in good order.
  void Terminate(std::chrono::milliseconds grace);

  // Sends a signal to the child; nothing once Poll() has told its end.
  void Forward(int signal);

  // Blocks until the end and gives Poll()'s answer. Never returns if the child is not released and
  // not terminated.
  int Wait();

  pid_t pid() const { return pid_; }

 private:
  std::string program_;
  UniqueFd gate_;  // one byte out: go; four bytes in: errno of exec; end of file in: exec done
  pid_t pid_ = -1;
  std::optional<int> exit_code_;
  std::optional<std::chrono::steady_clock::time_point> kill_at_;
};

}  // namespace understudy::exec
