#include "exec/child_process.h"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>  // mkstemp, setenv
#include <unistd.h>

#include "forked.h"
#include "tests/support/eventually.h"
#include "tests/support/temporary_folder.h"

namespace understudy::exec {
namespace {

using std::chrono::milliseconds;
using ::testing::HasSubstr;
using ::understudy::test::Forked;
using ::understudy::test::InFork;
using ::understudy::test::Pipe;
using ::understudy::test::ReachesEnd;
using ::understudy::test::ReadAll;
using ::understudy::test::ReadLine;
using ::understudy::test::WriteLine;

constexpr milliseconds kLong{60000};

// A pipe that commands write to as descriptor 9 (a plain sh knows one digit).
class NinePipe {
 public:
  NinePipe() {
    if (::dup2(pipe_.in.get(), 9) != 9) throw std::runtime_error("no descriptor 9");
    pipe_.in.reset();
  }
  NinePipe(const NinePipe&) = delete;
  NinePipe& operator=(const NinePipe&) = delete;
  ~NinePipe() { CloseOurs(); }
  void CloseOurs() {
    if (open_) ::close(9);
    open_ = false;
  }
  int out() const { return pipe_.out.get(); }

 private:
  Pipe pipe_;
  bool open_ = true;
};

std::vector<std::string> Shell(const std::string& script) { return {"sh", "-c", script}; }

int CodeOf(const std::string& script, const ChildProcess::Environment& additions = {}) {
  ChildProcess child(Shell(script), additions);
  child.Release();
  return child.Wait();
}

void Handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(signal, &action, nullptr);
}

// The word after the name in /proc/PID/stat: 0 is its state, 1 its parent, 2 its process group.
std::string StatOf(const std::string& pid, int word) {
  std::ifstream file("/proc/" + pid + "/stat");
  std::string text, found;
  std::getline(file, text);
  std::istringstream words(text.substr(std::min(text.rfind(')') + 1, text.size())));
  for (int i = 0; i <= word; ++i) words >> found;
  return found;
}

// An executable file with the given first bytes.
struct Script {
  explicit Script(const std::string& content) : path(folder.Write("script", content).string()) {
    std::filesystem::permissions(path, std::filesystem::perms::owner_all);
  }
  const test::TemporaryFolder folder;
  const std::string path;
};

TEST(ChildProcessTest, PassesTheExitCodeThrough) {
  EXPECT_EQ(CodeOf("exit 0"), 0);
  EXPECT_EQ(CodeOf("exit 7"), 7);
}

TEST(ChildProcessTest, AddsTheSignalTo128) {
  EXPECT_EQ(CodeOf("kill -9 $$"), 128 + SIGKILL);
  EXPECT_EQ(CodeOf("kill -15 $$"), 128 + SIGTERM);
}

TEST(ChildProcessTest, PassesArgumentsUnchanged) {
  ChildProcess child({"sh", "-c", "test \"$1\" = 'a  b' && test \"$2\" = '*'", "sh", "a  b", "*"});
  child.Release();
  EXPECT_EQ(child.Wait(), 0);
}

TEST(ChildProcessTest, AddsAndReplacesEnvironment) {
  ::setenv("UNDERSTUDY_OLD", "old", 1);
  ::setenv("UNDERSTUDY_KEPT", "kept", 1);
  EXPECT_EQ(CodeOf("test \"$UNDERSTUDY_OLD,$UNDERSTUDY_NEW,$UNDERSTUDY_KEPT\" = 'new,a=b c,kept'",
                   {{"UNDERSTUDY_OLD", "new"}, {"UNDERSTUDY_NEW", "a=b c"}}),
            0);
  EXPECT_STREQ(::getenv("UNDERSTUDY_OLD"), "old");
}

TEST(ChildProcessTest, SearchesThePathOfTheCommandsEnvironment) {
  EXPECT_THROW(ChildProcess(Shell("exit 0"), {{"PATH", "/nowhere"}}), CommandError);
}

TEST(ChildProcessTest, RefusesAnUnknownCommandBeforeItForks) {
  try {
    ChildProcess child({"no-such-program-of-ours"});
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code(), 127);
    EXPECT_THAT(error.what(), HasSubstr("no-such-program-of-ours"));
  }
}

TEST(ChildProcessTest, RefusesAFileThatIsNotExecutable) {
  try {
    ChildProcess child({"/etc/passwd"});
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code(), 126);
  }
}

TEST(ChildProcessTest, RefusesAnEmptyCommand) {
  try {
    ChildProcess child(std::vector<std::string>{});
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code(), 125);
  }
}

// Before a robot is started for it.
TEST(ChildProcessTest, TellsAMissingInterpreterAtOnce) {
  const Script script("#!/nowhere/interpreter\n");
  try {
    const ChildProcess child({script.path});
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code(), 127);
    EXPECT_THAT(error.what(), HasSubstr("/nowhere/interpreter"));
  }
}

TEST(ChildProcessTest, TellsAFileThatTheKernelRefusesAtRelease) {
  const Script script("");
  std::ofstream(script.path) << "#!" << script.path << "\n";  // its own interpreter, for ever
  ChildProcess child({script.path});
  try {
    child.Release();
    FAIL();
  } catch (const CommandError& error) {
    EXPECT_EQ(error.exit_code(), 126);
  }
  EXPECT_EQ(child.Wait(), 126);
}

TEST(ChildProcessTest, RunsAScriptWithoutFirstLineInAShell) {
  const Script script("exit 5\n");
  ChildProcess child({script.path});
  child.Release();
  EXPECT_EQ(child.Wait(), 5);
}

TEST(ChildProcessTest, RunsNothingWhenNeverReleased) {
  NinePipe nine;
  {
    ChildProcess child(Shell("echo ran >&9"));
    nine.CloseOurs();
    EXPECT_FALSE(child.Poll());
  }
  EXPECT_EQ(ReadAll(nine.out()), "");
}

TEST(ChildProcessTest, RunsNothingWhenTheParentDiesFirst) {
  NinePipe nine;
  Forked parent([&] {
    const ChildProcess child(Shell("echo ran >&9"));
    ::_exit(0);
    return std::string();
  });
  nine.CloseOurs();
  parent.Result();
  EXPECT_EQ(ReadAll(nine.out()), "");
}

TEST(ChildProcessTest, RunsOnlyAfterRelease) {
  NinePipe nine;
  ChildProcess child(Shell("echo ran >&9"));
  EXPECT_FALSE(child.Poll());
  WriteLine(9, "released");
  child.Release();
  nine.CloseOurs();
  EXPECT_EQ(ReadAll(nine.out()), "released\nran\n");
  EXPECT_EQ(child.Wait(), 0);
}

TEST(ChildProcessTest, IgnoresASecondRelease) {
  ChildProcess child(Shell("exit 4"));
  child.Release();
  child.Release();
  EXPECT_EQ(child.Wait(), 4);
}

TEST(ChildProcessTest, SurvivesReleaseOfAChildKilledAtTheGate) {
  ChildProcess child(Shell("exit 0"));
  child.Forward(SIGKILL);
  EXPECT_EQ(child.Wait(), 128 + SIGKILL);  // the signal goes by way of the keeper
  child.Release();
  EXPECT_EQ(child.Wait(), 128 + SIGKILL);
}

TEST(ChildProcessTest, ForwardsASignal) {
  NinePipe nine;
  ChildProcess child(Shell("trap 'exit 42' USR1; echo ready >&9; while :; do :; done"));
  child.Release();
  ASSERT_EQ(ReadLine(nine.out()), "ready");
  child.Forward(SIGUSR1);
  EXPECT_EQ(child.Wait(), 42);
}

TEST(ChildProcessTest, LeavesTheProgramItsOwnWayOutAtTerminate) {
  NinePipe nine;
  ChildProcess child(Shell("trap 'exit 3' TERM; echo ready >&9; while :; do :; done"));
  child.Release();
  ASSERT_EQ(ReadLine(nine.out()), "ready");
  child.Terminate(kLong);
  EXPECT_EQ(child.Wait(), 3);
}

TEST(ChildProcessTest, KillsAStubbornProgramAfterTheGrace) {
  NinePipe nine;
  ChildProcess child(Shell("trap '' TERM; echo ready >&9; exec sleep 60"));
  child.Release();
  ASSERT_EQ(ReadLine(nine.out()), "ready");
  child.Terminate(milliseconds(0));
  EXPECT_EQ(child.Wait(), 128 + SIGKILL);
}

TEST(ChildProcessTest, TerminatesAStoppedProgram) {
  NinePipe nine;
  ChildProcess child(Shell("trap 'exit 3' TERM; echo $$ >&9; kill -STOP $$; exit 1"));
  child.Release();
  const std::string pid = ReadLine(nine.out());
  ASSERT_TRUE(test::Eventually([&] { return StatOf(pid, 0) == "T"; }));
  child.Terminate(kLong);  // SIGTERM alone would wait for somebody to continue it
  EXPECT_EQ(child.Wait(), 3);
}

TEST(ChildProcessTest, EndsTheProgramWhenItGoesOutOfScope) {
  NinePipe nine;
  {
    ChildProcess child(Shell("trap '' TERM; echo ready >&9; exec sleep 60"));
    nine.CloseOurs();
    child.Release();
    ASSERT_EQ(ReadLine(nine.out()), "ready");
  }
  EXPECT_TRUE(ReachesEnd(nine.out()));
}

// Whether all that a shell has started is gone once our process has been killed.
bool IsGoneWithItsParent(const std::string& script) {
  NinePipe nine;
  Forked parent([&script] {
    ChildProcess child(Shell(script));
    child.Release();
    return std::to_string(child.Wait());
  });
  nine.CloseOurs();
  EXPECT_EQ(ReadLine(nine.out()), "ready");
  parent.Kill();
  return ReachesEnd(nine.out());
}

TEST(ChildProcessTest, EndsTheProgramWhenTheParentIsKilled) {
  EXPECT_TRUE(IsGoneWithItsParent("trap '' TERM; echo ready >&9; exec sleep 60"));
}

TEST(ChildProcessTest, EndsWhatTheCommandLeaves) {
  NinePipe nine;
  ChildProcess child(Shell("(trap '' TERM; sh -c 'sleep 60; :') & (setsid sleep 60 &) & exit 5"));
  nine.CloseOurs();
  child.Release();
  EXPECT_EQ(child.Wait(), 5);
  EXPECT_TRUE(ReachesEnd(nine.out()));
}

TEST(ChildProcessTest, LeavesWhatTheCommandLeavesItsOwnWayOut) {
  NinePipe nine;
  ChildProcess child(
      Shell("sh -c 'trap \"echo bye >&9; exit\" TERM; echo on >&9; sleep 60 & wait' & "
            "sleep 60"));
  child.Release();
  ASSERT_EQ(ReadLine(nine.out()), "on");
  child.Terminate(kLong);
  EXPECT_EQ(ReadLine(nine.out()), "bye");
}

TEST(ChildProcessTest, EndsTheChildrenOfTheProgramWhenTheParentIsKilled) {
  EXPECT_TRUE(IsGoneWithItsParent("(trap '' TERM; sleep 60; :) & echo ready >&9; exec sleep 60"));
}

TEST(ChildProcessTest, KeepsTheAnswerOfPollAndSignalsNobodyAfterwards) {
  ChildProcess child(Shell("exit 6"));
  child.Release();
  EXPECT_EQ(child.Wait(), 6);
  child.Forward(SIGKILL);
  child.Terminate(milliseconds(0));
  EXPECT_EQ(child.Poll(), 6);
}

TEST(ChildProcessTest, StaysInOurProcessGroup) {
  NinePipe nine;
  ChildProcess child(Shell("echo $$ >&9; exec sleep 60"));
  child.Release();
  EXPECT_EQ(StatOf(ReadLine(nine.out()), 2), std::to_string(::getpgrp()));
}

TEST(ChildProcessTest, HasTheMaskFromBeforeItWasForked) {
  EXPECT_EQ(InFork([] {
              ChildProcess child(Shell("kill -TERM $$; exit 0"));
              sigset_t all;
              ::sigfillset(&all);
              ::sigprocmask(SIG_BLOCK, &all, nullptr);
              Handle(SIGTERM, SIG_IGN);
              child.Release();
              return std::to_string(child.Wait());
            }),
            std::to_string(128 + SIGTERM));
}

TEST(ChildProcessTest, RunsNoHandlerOfOursAtTheGate) {
  EXPECT_EQ(InFork([] {
              Handle(SIGTERM, [](int) {});
              ChildProcess child(Shell("exit 0"));
              child.Terminate(kLong);
              return std::to_string(child.Wait());
            }),
            std::to_string(128 + SIGTERM));
}

TEST(ChildProcessTest, KeepsTheExitCodeWhereChildrenWereIgnored) {
  EXPECT_EQ(InFork([] {
              Handle(SIGCHLD, SIG_IGN);
              return std::to_string(CodeOf("exit 9"));
            }),
            "9");
}

}  // namespace
}  // namespace understudy::exec
