#include "exec/program_output.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "exec/child_process.h"
#include "forked.h"

namespace understudy::exec {
namespace {

using test::Pipe;

// Our standard output is a pipe for as long as this.
class Redirected {
 public:
  Redirected() : before_(::dup(STDOUT_FILENO)) { ::dup2(pipe_.in.get(), STDOUT_FILENO); }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;
  ~Redirected() { Restore(); }

  // What came, up to the end.
  std::string Restore() {
    if (!before_.valid()) return {};
    ::dup2(before_.get(), STDOUT_FILENO);
    before_.reset();
    pipe_.in.reset();
    return test::ReadAll(pipe_.out.get());
  }

 private:
  Pipe pipe_;
  UniqueFd before_;
};

struct Heard {
  std::string passed_on;
  std::vector<std::string> found;
};

// Runs a shell to its end.
Heard Hear(const std::string& shell, const std::vector<std::string>& texts) {
  Heard heard;
  Redirected redirected;
  ProgramOutput output(texts);
  const auto take = [&] {
    output.TakeFound([&](const std::string& text) { heard.found.push_back(text); });
  };
  ChildProcess child({"sh", "-c", shell}, {}, -1, output.descriptor());
  output.Start();
  child.Release();
  while (!child.Poll()) {
    take();
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  output.Finish();
  for (int i = 0; i < 10; ++i) take();
  heard.passed_on = redirected.Restore();
  return heard;
}

TEST(ProgramOutputTest, PassesOnWhatItReadsByteForByte) {
  EXPECT_EQ(Hear("printf 'a\\tb\\nc\\r\\nd'", {"x"}).passed_on, "a\tb\nc\r\nd");
}

TEST(ProgramOutputTest, KeepsTheLastLineThatIsNotBlank) {
  const Redirected redirected;
  ProgramOutput errors({}, STDERR_FILENO);
  ChildProcess child({"sh", "-c", "echo first >&2; printf 'last\n \n' >&2"}, {},
                     errors.descriptor());
  errors.Start();
  child.Release();
  child.Wait();
  errors.Finish();
  EXPECT_EQ(errors.last_line(), "last");
}

TEST(ProgramOutputTest, FindsATextOnceInALine) {
  const Heard heard = Hear("echo is ready ready; echo not; echo ready", {"ready", "never"});
  EXPECT_THAT(heard.found, testing::ElementsAre("ready", "ready"));
}

TEST(ProgramOutputTest, FindsATextInALineWithoutEndWhileTheProgramGoesOn) {
  ProgramOutput output({"ready>"});
  ChildProcess child({"sh", "-c", "printf 'rea'; printf 'dy> '; exec sleep 60"}, {}, -1,
                     output.descriptor());
  output.Start();
  child.Release();
  bool found = false;
  const auto until = std::chrono::steady_clock::now() + std::chrono::seconds(30);
  while (!found && std::chrono::steady_clock::now() < until) {
    output.TakeFound([&](const std::string&) { found = true; });
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  EXPECT_TRUE(found);
  EXPECT_FALSE(child.Poll());
}

TEST(ProgramOutputTest, IsATerminalToTheProgram) {
  EXPECT_THAT(Hear("test -t 1 && echo yes", {"yes"}).found, testing::ElementsAre("yes"));
}

TEST(ProgramOutputTest, TellsNoMoreAtOnceThanATickHasTimeFor) {
  ProgramOutput output({"x"});
  ChildProcess child({"sh", "-c", "for i in $(seq 40); do echo x; done"}, {}, -1,
                     output.descriptor());
  output.Start();
  child.Release();
  child.Wait();
  output.Finish();
  std::vector<int> counts;
  for (int i = 0; i < 4; ++i) {
    counts.push_back(0);
    output.TakeFound([&](const std::string&) { ++counts.back(); });
  }
  EXPECT_THAT(counts, testing::ElementsAre(16, 16, 8, 0));
}

}  // namespace
}  // namespace understudy::exec
