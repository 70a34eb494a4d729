// Tests which joint friction, damping and armature a robot gets: robot.dynamics.
#include "config_fixture.h"
#include "robot/motor.h"
#include "tests/support/robots.h"

namespace understudy::config {
namespace {

using testing::HasSubstr;

const std::filesystem::path kSource = UNDERSTUDY_SOURCE_DIR;

robot::RobotSpec Shipped(const std::string& robot, const std::vector<std::string>& sets = {}) {
  return LoadConfig({.robot = robot, .files = {}, .sets = sets}, kSource).robots[0].spec;
}

TEST(DynamicsTest, ARobotUsesTheFitWhereThereIsOne) {
  for (const std::string& name : RobotNames(kSource)) {
    const robot::DynamicsSpec dynamics = Shipped(name).dynamics;
    EXPECT_EQ(dynamics.use == robot::DynamicsSource::kFitted, !dynamics.fitted.empty()) << name;
  }
  for (const std::string name : {"g1", "go2", "go2w"}) {
    EXPECT_EQ(Shipped(name).dynamics.use, robot::DynamicsSource::kFitted) << name;
  }
}

TEST(DynamicsTest, ARobotWithoutAFitSaysSo) {
  const std::vector<std::string> without =
      test::RobotsThat([](const robot::RobotSpec& spec) { return spec.dynamics.fitted.empty(); });
  EXPECT_FALSE(without.empty());
  for (const std::string& name : without) {
    EXPECT_EQ(ErrorOf([&] { Shipped(name, {"robot.dynamics.use=fitted"}); }),
              "--set robot.dynamics.use=fitted: robot.dynamics.use: robot '" + name +
                  "' has no fitted figures; choose catalogue");
  }
}

// N·m s/rad with which a G1's motor brakes a joint that a client commands with kd = 2, in PR mode.
double EffectiveKd(const robot::RobotSpec& g1, const std::string& joint) {
  const std::size_t count = g1.motors.size();
  robot::MotorBank bank(g1, 0.001);
  robot::RobotCommand command;
  command.motors.assign(count, {.enabled = true, .kd = 2});
  const std::vector<double> q(count, 0.0), dq(count, 1.0);
  const std::span<const double> torque = bank.Step({.command = command, .q = q, .dq = dq});
  for (std::size_t i = 0; i < count; ++i) {
    if (g1.motors[i].joint == joint) return -torque[i];
  }
  ADD_FAILURE() << "no joint " << joint;
  return 0;
}

// docs/dev/sources.md#parallel-pairs: four sessions of a real G1 show kd times 1.38 to 1.69 at
// ankle and waist pitch, 0.46 to 0.55 at their roll and 0.97 to 1.00 elsewhere.
TEST(DynamicsTest, ParallelJointsOfAG1BrakeAsLogsOfARealOneShow) {
  const robot::RobotSpec g1 = Shipped("g1");
  for (const std::string part : {"left_ankle", "right_ankle", "waist"}) {
    const double pitch = EffectiveKd(g1, part + "_pitch_joint") / 2;
    const double roll = EffectiveKd(g1, part + "_roll_joint") / 2;
    EXPECT_GT(pitch, 1.38) << part;
    EXPECT_LT(pitch, 1.69) << part;
    EXPECT_GT(roll, 0.46) << part;
    EXPECT_LT(roll, 0.55) << part;
  }
  for (const std::string joint : {"left_knee_joint", "waist_yaw_joint", "right_elbow_joint"}) {
    EXPECT_EQ(EffectiveKd(g1, joint), 2) << joint;
  }
}

TEST(DynamicsTest, ParallelJointsOfAG1BrakeAsCommandedUnderCatalogue) {
  const robot::RobotSpec g1 = Shipped("g1", {"robot.dynamics=catalogue"});
  EXPECT_EQ(EffectiveKd(g1, "left_ankle_pitch_joint"), 2);
  EXPECT_EQ(EffectiveKd(g1, "waist_roll_joint"), 2);
}

TEST(DynamicsTest, AnotherModelKeepsItsOwnJointsUnlessToldOtherwise) {
  const std::string model = "robot.model=/elsewhere/go2.xml";
  EXPECT_EQ(Shipped("go2", {model}).dynamics.use, robot::DynamicsSource::kCatalogue);
  EXPECT_EQ(Shipped("go2", {model, "robot.dynamics.use=fitted"}).dynamics.use,
            robot::DynamicsSource::kFitted);
  EXPECT_EQ(Shipped("go2", {"robot.dynamics=fitted", model}).dynamics.use,
            robot::DynamicsSource::kFitted);
  EXPECT_EQ(Shipped("go2", {"robot.model=go2/go2.xml"}).dynamics.use,
            robot::DynamicsSource::kFitted);
}

class DynamicsMisuseTest : public ConfigFixture {};

TEST_F(DynamicsMisuseTest, SuggestsTheNearestWord) {
  EXPECT_EQ(
      SetError("robot.dynamics.use=fited"),
      "--set robot.dynamics.use=fited: robot.dynamics.use: expected one of catalogue, fitted, "
      "got 'fited'; did you mean 'fitted'?");
}

TEST_F(DynamicsMisuseTest, RefusesFiguresOfSlotsWithoutAMotor) {
  EXPECT_THAT(
      SetError("robot.dynamics={use: fitted, fitted: [{slots: [7, 8], damping: 1}]}"),
      HasSubstr("robot.dynamics.fitted.0.slots: expected slots of motors; none of these has"));
}

TEST_F(DynamicsMisuseTest, PassesOverASlotThatIsEmpty) {
  EXPECT_EQ(SetError("robot.dynamics={use: fitted, fitted: [{slots: [0, 7], damping: 1}]}"), "");
}

TEST_F(DynamicsMisuseTest, RefusesTwoFiguresForOneSlot) {
  EXPECT_THAT(SetError("robot.dynamics={use: fitted, fitted: [{slots: [0]}, {slots: [1, 0]}]}"),
              HasSubstr("robot.dynamics.fitted.1.slots: slot 0 has figures already"));
}

TEST_F(DynamicsMisuseTest, RefusesFiguresOfNoSlot) {
  EXPECT_THAT(SetError("robot.dynamics={use: fitted, fitted: [{damping: 1}]}"),
              HasSubstr("robot.dynamics.fitted.0.slots: expected slots of motors"));
}

TEST_F(DynamicsMisuseTest, LeavesFiguresThatAreNotUsedAlone) {
  EXPECT_EQ(SetError("robot.dynamics={use: catalogue, fitted: [{slots: [7]}]}"), "");
}

TEST_F(DynamicsMisuseTest, RefusesADelayThatIsNoDelay) {
  EXPECT_THAT(SetError("robot.dynamics.delay=-0.001"),
              HasSubstr("expected a number from 0 to 0.1 s"));
  EXPECT_THAT(SetError("robot.dynamics.delay=nan"), HasSubstr("expected a number from 0 to 0.1 s"));
}

}  // namespace
}  // namespace understudy::config
