#include "ctl/command.h"

#include <cstdio>
#include <sstream>
#include <thread>

#include <CLI/CLI.hpp>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/ctl/fake_robot.h"

namespace understudy::ctl {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::StartsWith;
using ::testing::ThrowsMessage;

emulator::Status Ready() {
  emulator::Status status;
  status.loop.ready = true;
  status.steps = 5;
  return status;
}

class CtlCommandTest : public ::testing::Test {
 protected:
  // Nobody is to be asked, from wherever the tests are run.
  CtlCommandTest() { EXPECT_NE(std::freopen("/dev/null", "r", stdin), nullptr); }

  std::filesystem::path Socket(const std::string& name) const {
    return temp_.path() / (name + ".sock");
  }
  // Parses and runs one command line; returns what it printed.
  static std::string Run(const std::string& line) {
    CLI::App app;
    std::ostringstream out;
    CtlCommand dut(&app, &out);
    app.parse(line);
    if (!dut.chosen()) throw std::logic_error("nothing was chosen by: " + line);
    dut.Run();
    return out.str();
  }

  test::TemporaryFolder temp_;
  test::ScopedEnv folder_{"UNDERSTUDY_RUNTIME_DIR", temp_.path().string()};
  test::ScopedEnv control_{"UNDERSTUDY_CONTROL", std::nullopt};
};

TEST_F(CtlCommandTest, ShowsTheStatusOfTheOnlyRobot) {
  FakeRobot robot(Socket("one"));
  robot.board()->Post(Ready());
  EXPECT_THAT(Run("ctl status"), AllOf(HasSubstr("steps              5\n"), HasSubstr("ready")));
}

TEST_F(CtlCommandTest, ShowsTheStatusAsOneLineOfJson) {
  FakeRobot robot(Socket("one"));
  robot.board()->Post(Ready());
  const std::string text = Run("ctl status --json");
  EXPECT_EQ(nlohmann::json::parse(text)["steps"], 5);
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 1);
}

TEST_F(CtlCommandTest, WatchesUntilTheRobotIsGone) {
  auto robot = std::make_unique<FakeRobot>(Socket("one"));
  std::string why;
  std::thread watching([&] {
    try {
      Run("ctl status --json --watch --socket " + Socket("one").string());
    } catch (const ControlError& error) {
      why = error.what();
    }
  });
  robot.reset();
  watching.join();
  EXPECT_NE(why, "");
}

TEST_F(CtlCommandTest, WatchesSnapshotsUntilTheRobotGoes) {
  std::optional<FakeRobot> robot(std::in_place, Socket("one"));
  std::ostringstream out;
  CLI::App app;
  CtlCommand dut(&app, &out);
  app.parse("ctl snapshot --watch --hz 240 --parts com --socket " + Socket("one").string());
  std::thread watching([&] { EXPECT_THROW(dut.Run(), ControlError); });
  const std::int64_t before = robot->shown();
  EXPECT_TRUE(test::Eventually([&] { return robot->shown() > before + 2; }));
  robot.reset();
  watching.join();
  std::istringstream lines(out.str());
  int seen = 0;
  for (std::string line; std::getline(lines, line); ++seen) {
    EXPECT_THAT(line, AllOf(StartsWith("{\"step\":"), HasSubstr("\"com\":")));
  }
  EXPECT_GE(seen, 2);
}

TEST_F(CtlCommandTest, PrintsOneSnapshotAndTheFiguresForPrometheus) {
  const FakeRobot robot(Socket("one"));
  EXPECT_THAT(Run("ctl snapshot --parts com"), StartsWith("{\"step\":"));
  EXPECT_THAT(Run("ctl metrics"), HasSubstr("\nunderstudy_steps_total "));
  EXPECT_THAT(Run("ctl events"), EndsWith(" s  clamped\n"));
}

TEST_F(CtlCommandTest, ChecksDamageByItsExitCodeOnlyWhereItIsAskedTo) {
  emulator::Snapshot snapshot;
  snapshot.damage.falls = 1;
  snapshot.damage_limits = {{"falls", 0, "", "assumed: none"}};
  const FakeRobot robot(Socket("one"), {}, snapshot);
  const auto code_of = [](const std::string& line) {
    CLI::App app;
    std::ostringstream out;
    CtlCommand dut(&app, &out);
    app.parse(line);
    const ExitCode code = dut.Run();
    EXPECT_THAT(out.str(), HasSubstr("falls"));
    return code;
  };
  EXPECT_EQ(code_of("ctl damage"), ExitCode::kOk);
  EXPECT_EQ(code_of("ctl damage --check"), ExitCode::kFailed);
  EXPECT_EQ(code_of("ctl damage --check --json"), ExitCode::kFailed);
}

TEST_F(CtlCommandTest, AnArgumentThatIsNoTextReachesTheRobot) {
  const FakeRobot robot(Socket("one"));
  Run("ctl push \xff\xfe 1 0 0");
  EXPECT_EQ(robot.last().name(), "\xef\xbf\xbd\xef\xbf\xbd");
}

TEST_F(CtlCommandTest, AsksForWhatTheVerbSays) {
  const FakeRobot robot(Socket("one"));
  const auto asked = [&](const std::string& line) {
    EXPECT_EQ(Run(line), "");
    return emulator::Describe(robot.last());
  };
  EXPECT_EQ(asked("ctl crane lower 0.25"), "crane.lower 0.25 m");
  EXPECT_EQ(asked("ctl crane lower -0.5"), "crane.lower -0.5 m");
  EXPECT_EQ(asked("ctl crane attach"), "crane.attach");
  EXPECT_EQ(asked("ctl clamp on"), "clamp on");
  EXPECT_EQ(asked("ctl clamp off"), "clamp off");
  EXPECT_EQ(asked("ctl pause"), "pause");
  EXPECT_EQ(asked("ctl resume"), "resume");
  EXPECT_EQ(asked("ctl speed 0.5"), "speed 0.5 s/s");
  EXPECT_EQ(asked("ctl speed max"), "speed max");
  EXPECT_EQ(asked("ctl reset"), "reset");
  EXPECT_EQ(asked("ctl reset hanging"), "reset hanging");
  EXPECT_EQ(asked("ctl step"), "step");
  EXPECT_EQ(asked("ctl step 250"), "step 250");
  EXPECT_EQ(asked("ctl drag trunk 0.1 -0.2 0.6 --at 0 0 -0.05 --for 5"),
            "drag trunk 0.1 -0.2 0.6 m at 0 0 -0.05 m for 5 s");
  EXPECT_EQ(asked("ctl let_go trunk"), "let_go trunk");
  EXPECT_EQ(asked("ctl let_go"), "let_go");
  EXPECT_EQ(asked("ctl push trunk -40 0 1.5 --for 0.5"), "push trunk -40 0 1.5 N for 0.5 s");
  EXPECT_EQ(asked("ctl push --impulse 0 2 0"), "push impulse 0 2 0 N·s");
  EXPECT_EQ(asked("ctl remote sticks --ly 0.5 --for 2"), "remote.sticks ly 0.5 for 2 s");
}

TEST_F(CtlCommandTest, ARequestPrintsTheReplyOnlyAsJson) {
  const FakeRobot robot(Socket("one"));
  EXPECT_EQ(Run("ctl pause"), "");
  EXPECT_EQ(Run("ctl pause --json"), "{\"ok\":true}\n");
  EXPECT_EQ(Run("ctl crane attach --json"), "{\"ok\":true}\n");
}

TEST_F(CtlCommandTest, ARefusalIsAnErrorWithTheRobotsReason) {
  const FakeRobot robot(Socket("one"), Error{"it does not hang"});
  EXPECT_THAT([] { Run("ctl crane lower 1"); }, ThrowsMessage<ControlError>("it does not hang"));
}

TEST_F(CtlCommandTest, WithoutARobotItSaysHowToStartOne) {
  EXPECT_THAT([] { Run("ctl status"); },
              ThrowsMessage<ControlError>(HasSubstr("understudy run g1")));
}

TEST_F(CtlCommandTest, WithSeveralRobotsItSaysHowToChoose) {
  const FakeRobot one(Socket("one"));
  const FakeRobot two(Socket("two"));
  EXPECT_THAT([] { Run("ctl status"); },
              ThrowsMessage<ControlError>(AllOf(HasSubstr("one, two"), HasSubstr("--robot NAME"))));
  EXPECT_THAT([] { Run("ctl wait"); }, ThrowsMessage<ControlError>(HasSubstr("one, two")));
}

TEST_F(CtlCommandTest, ANameChoosesBeforeOrAfterTheSubcommand) {
  const FakeRobot one(Socket("one"));
  FakeRobot two(Socket("two"));
  two.board()->Post(Ready());
  EXPECT_EQ(nlohmann::json::parse(Run("ctl --name two status --json"))["steps"], 5);
  EXPECT_EQ(nlohmann::json::parse(Run("ctl status --json --name two"))["steps"], 5);
  Run("ctl crane attach --name two");
  EXPECT_EQ(two.last().row->name, "crane.attach");
}

TEST_F(CtlCommandTest, AnUnknownNameIsAnErrorWithTheNearest) {
  const FakeRobot left(Socket("left"));
  const FakeRobot right(Socket("right"));
  EXPECT_THAT([] { Run("ctl status --name rihgt"); },
              ThrowsMessage<ControlError>(R"(no robot named "rihgt" runs: did you mean "right"?)"));
  EXPECT_THAT([] { Run("ctl status --name go2"); },
              ThrowsMessage<ControlError>(R"(no robot named "go2" runs; there are left, right)"));
}

TEST_F(CtlCommandTest, ANameThatCanBeNoneIsAnError) {
  EXPECT_THROW(Run("ctl status --name ../x"), ControlError);
}

TEST_F(CtlCommandTest, TheEnvironmentNamesASocketAndAnOptionOverridesIt) {
  FakeRobot one(Socket("one"));
  const FakeRobot two(Socket("two"));
  one.board()->Post(Ready());
  const test::ScopedEnv control("UNDERSTUDY_CONTROL", Socket("one").string());
  EXPECT_EQ(nlohmann::json::parse(Run("ctl status --json"))["steps"], 5);
  EXPECT_EQ(nlohmann::json::parse(Run("ctl status --json --name two"))["steps"], 0);
  EXPECT_EQ(
      nlohmann::json::parse(Run("ctl status --json --socket " + Socket("two").string()))["steps"],
      0);
}

TEST_F(CtlCommandTest, WaitReturnsAtOnceWhenTheRobotIsReady) {
  FakeRobot robot(Socket("one"));
  robot.board()->Post(Ready());
  EXPECT_EQ(Run("ctl wait --timeout 0"), "");
}

TEST_F(CtlCommandTest, WaitsForTheRobotToAppearAndBecomeReady) {
  std::thread waiting([] { EXPECT_EQ(Run("ctl wait --timeout 10"), ""); });
  FakeRobot robot(Socket("one"));
  robot.board()->Post(Ready());
  waiting.join();
}

TEST_F(CtlCommandTest, WaitGivesUpAndSaysWhatWasMissing) {
  EXPECT_THAT([] { Run("ctl wait --timeout 0.05"); },
              ThrowsMessage<ControlError>(AllOf(StartsWith("no robot was ready after 50 ms: "),
                                                HasSubstr("no robot runs"))));
  const FakeRobot robot(Socket("one"));
  EXPECT_THAT([] { Run("ctl wait --timeout 0"); },
              ThrowsMessage<ControlError>(HasSubstr("it is starting")));
}

TEST_F(CtlCommandTest, ASilencedRobotIsNotReady) {
  FakeRobot robot(Socket("one"));
  emulator::Status status = Ready();
  status.silenced = true;
  robot.board()->Post(status);
  EXPECT_THAT([] { Run("ctl wait --timeout 0"); },
              ThrowsMessage<ControlError>(HasSubstr("silenced")));
}

TEST_F(CtlCommandTest, ListsTheRobots) {
  EXPECT_EQ(Run("ctl list"), "no robot runs\n");
  EXPECT_EQ(Run("ctl list --json"), "[]\n");
  const FakeRobot robot(Socket("one"));
  EXPECT_THAT(Run("ctl list"), HasSubstr("one   " + std::to_string(::getpid())));
  const auto list = nlohmann::json::parse(Run("ctl list --json"));
  EXPECT_EQ(list[0]["name"], "one");
  EXPECT_EQ(list[0]["socket"], Socket("one").string());
  EXPECT_EQ(list[0]["pid"], ::getpid());
}

TEST_F(CtlCommandTest, RefusesWhatIsMissingTooMuchOrOutOfRange) {
  for (const char* line : {"ctl",
                           "ctl dance",
                           "ctl step 0",
                           "ctl step 1.5",
                           "ctl step 1000001",
                           "ctl speed",
                           "ctl speed fast",
                           "ctl speed -1",
                           "ctl speed 0.0001",
                           "ctl drag",
                           "ctl drag trunk",
                           "ctl drag trunk 1 2",
                           "ctl drag trunk 1 2 x",
                           "ctl drag trunk 1 2 3 --for 61",
                           "ctl drag trunk 1 2 3 --at 0 0",
                           "ctl snapshot --parts qpos&x=1",
                           "ctl status --watch --every 0",
                           "ctl crane lower",
                           "ctl crane lower far",
                           "ctl crane lower nan",
                           "ctl crane raise 11",
                           "ctl clamp",
                           "ctl clamp maybe",
                           "ctl wait --timeout -1",
                           "ctl status --name one --socket /x"}) {
    EXPECT_THROW(Run(line), CLI::ParseError) << line;
  }
  EXPECT_THAT([] { Run("ctl reset standin"); },
              ThrowsMessage<CLI::ParseError>(HasSubstr("did you mean 'standing'?")));
  EXPECT_THAT([] { Run("ctl speed 0"); },
              ThrowsMessage<CLI::ParseError>(StartsWith("speed: expected a number")));
}

}  // namespace
}  // namespace understudy::ctl
