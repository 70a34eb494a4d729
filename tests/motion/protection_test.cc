// What a motion service does by itself when something endangers the robot: each danger alone. In
// whole ticks: endangered_test.cc.
#include "motion/protection.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using authority::MotionGoal;
using authority::MotionVerdict;
using robot::Danger;
using robot::Protection;

constexpr double kStep = 0.01;  // s

// Takes every goal, but a fall only where it stands, if it knows falls at all.
class FakeMotion final : public authority::Motion {
 public:
  void Start(const authority::MotionInput&) override {}
  MotionVerdict Ask(const MotionGoal& goal) override {
    asked.push_back(goal);
    if (!std::holds_alternative<goal::Fall>(goal)) return MotionVerdict::kTaken;
    if (!knows_falls) return MotionVerdict::kUnable;
    return stands ? MotionVerdict::kTaken : MotionVerdict::kNotNow;
  }
  void Step(const authority::MotionInput&, double, robot::RobotCommand*) override {}
  robot::MotionState state() const override { return {.id = id, .name = "as it is"}; }

  std::vector<MotionGoal> asked;
  bool stands = true, knows_falls = true;
  int id = 0;
};

class ProtectionTest : public ::testing::Test {
 protected:
  ProtectionTest() { Make(); }

  // The protection of a Go2 with its rules as they are now.
  void Make() {
    auto bare = std::make_unique<FakeMotion>();
    bare_ = bare.get();
    motion_ =
        std::make_unique<ProtectedMotion>(config_.robots[0].spec, world_.robot(), std::move(bare));
    readings_ = std::vector<robot::MotorReading>(config_.robots[0].spec.motors.size());
    for (std::size_t i = 0; i < readings_.size(); ++i) {
      readings_[i] = {.q = config_.robots[0].spec.standing.q[i], .casing_c = 40, .winding_c = 50};
    }
    input_ = {};
    input_.motors = readings_;
    motion_->Start(input_);
  }

  robot::ProtectionRule& rule(Danger danger) {
    return config_.robots[0].spec.motion.protection.*
           Dangers()[static_cast<std::size_t>(danger)].rule;
  }

  // Brings about a danger of the Go2, and takes it away.
  void Endanger(Danger danger, bool on = true) {
    switch (danger) {
      case Danger::kTilt:
        input_.imu.R_WI = Eigen::AngleAxisd(on ? 1.3 : 1.1, Eigen::Vector3d::UnitX());
        return;
      case Danger::kOverspeed:
        readings_[4].dq = (on ? -1.6 : 1.4) * config_.robots[0].spec.motors[4].no_load_speed;
        return;
      case Danger::kJointEnd:
        readings_[4].q = world_.robot().ranges()[4][1] + (on ? 0.11 : 0.09);
        return;
      case Danger::kHeat:
        readings_[4].winding_c = on ? 111 : 109;
        return;
      case Danger::kCharge:
        input_.soc = on ? 0.19 : 0.21;
        return;
      case Danger::kMotor:
        readings_[4].silent = on;
        return;
      case Danger::kRemote:
        input_.remote = {.there = true, .ly = 1};
        Step(kStep);
        input_.remote = {.there = !on};
        return;
    }
  }

  void Step(double seconds) {
    robot::RobotCommand command;
    for (double t = 0; t < seconds - 1e-9; t += kStep) motion_->Step(input_, kStep, &command);
  }

  Protection does(Danger danger) const {
    return motion_->state().dangers[static_cast<std::size_t>(danger)].does;
  }

  config::Config config_ = ConfigOf("go2");
  physics::MujocoWorld world_ = PhysicsOf(config_);
  std::unique_ptr<ProtectedMotion> motion_;
  FakeMotion* bare_ = nullptr;
  std::vector<robot::MotorReading> readings_;
  authority::MotionInput input_;
};

constexpr Danger kAll[] = {Danger::kTilt,   Danger::kOverspeed, Danger::kJointEnd, Danger::kHeat,
                           Danger::kCharge, Danger::kMotor,     Danger::kRemote};
static_assert(std::size(kAll) == robot::kDangers);

TEST_F(ProtectionTest, IsToldAsAStateOfItsOwnWhileItDampsWhereTheRobotHasOne) {
  config_.robots[0].spec.motion.humanoid.protection = 12;
  Make();
  bare_->id = 1;
  EXPECT_EQ(motion_->state().id, 1);
  Endanger(Danger::kCharge);  // which stops
  Step(1);
  EXPECT_EQ(motion_->state().id, 1);
  Endanger(Danger::kTilt);
  Step(1);
  EXPECT_EQ(motion_->state().id, 12);
  EXPECT_EQ(motion_->state().name, "protection");
  bare_->id = 4;  // somebody has asked it for another state
  EXPECT_EQ(motion_->state().id, 4);
  bare_->id = 1;
  Endanger(Danger::kTilt, false);
  Step(1);
  EXPECT_EQ(motion_->state().id, 1);
  config_.robots[0].spec.motion.humanoid.protection = -1;
  Endanger(Danger::kTilt);
  Step(1);
  EXPECT_EQ(motion_->state().id, 1);
}

TEST_F(ProtectionTest, NothingIsDoneWhileAllIsWithinItsLimits) {
  for (const Danger danger : kAll) Endanger(danger, false);
  Step(5);
  EXPECT_TRUE(bare_->asked.empty());
  for (const Danger danger : kAll) EXPECT_EQ(does(danger), Protection::kNothing);
}

TEST_F(ProtectionTest, EachDangerBeyondItsLimitForItsTimeDoesOnceWhatItsRuleSays) {
  const std::map<Protection, std::size_t> goals = {
      {Protection::kStop, authority::kGoal<goal::StopMove>},
      {Protection::kLieDown, authority::kGoal<goal::StandDown>},
      {Protection::kDamp, authority::kGoal<goal::Damp>}};
  for (const Danger danger : kAll) {
    SCOPED_TRACE(Dangers()[static_cast<std::size_t>(danger)].name);
    for (const auto& [what, goal] : goals) {
      rule(danger).does = what;
      rule(danger).time = 0.3;
      Make();
      Endanger(danger);
      Step(0.29);
      EXPECT_TRUE(bare_->asked.empty());
      Step(1);
      ASSERT_EQ(bare_->asked.size(), 1U);
      const bool fall = danger == Danger::kTilt && what == Protection::kDamp;
      EXPECT_EQ(bare_->asked[0].index(), fall ? authority::kGoal<goal::Fall> : goal);
      EXPECT_EQ(does(danger), what);
      Endanger(danger, false);
      Step(0.45);
      EXPECT_EQ(does(danger), what) << "for a moment may be chance";
      Step(0.08);
      EXPECT_EQ(does(danger), Protection::kNothing);
      EXPECT_EQ(bare_->asked.size(), 1U);
    }
  }
}

TEST_F(ProtectionTest, AWarningOnlyTellsAndNothingIsNotEvenTold) {
  for (const Danger danger : kAll) {
    rule(danger).does = Protection::kWarn;
    Make();
    Endanger(danger);
    Step(2);
    EXPECT_EQ(does(danger), Protection::kWarn);
    EXPECT_EQ(motion_->Ask(goal::StandUp{}), MotionVerdict::kTaken);
    EXPECT_EQ(bare_->asked.size(), 1U);
    rule(danger).does = Protection::kNothing;
    Make();
    Endanger(danger);
    Step(2);
    EXPECT_EQ(does(danger), Protection::kNothing);
  }
}

TEST_F(ProtectionTest, TellsWhichMotorAndHowMuch) {
  Endanger(Danger::kHeat);
  readings_[2].winding_c = 110.5;
  Step(2);
  const robot::DangerReading heat =
      motion_->state().dangers[static_cast<std::size_t>(Danger::kHeat)];
  EXPECT_EQ(heat.motor, 4);
  EXPECT_EQ(heat.value, 111);
}

TEST_F(ProtectionTest, WhileAMotorIsHotOrSilentOnlyWhatRestsItIsTaken) {
  for (const Danger danger : {Danger::kHeat, Danger::kMotor}) {
    Make();
    Endanger(danger);
    Step(2);
    for (const MotionGoal& goal :
         {MotionGoal(goal::StandUp{}), MotionGoal(goal::Move{1, 0, 0, 1}),
          MotionGoal(goal::BalanceStand{}), MotionGoal(goal::RecoveryStand{}),
          MotionGoal(goal::SetFsm{500})}) {
      EXPECT_EQ(motion_->Ask(goal), MotionVerdict::kNotNow);
    }
    for (const MotionGoal& goal :
         {MotionGoal(goal::Damp{}), MotionGoal(goal::StandDown{}), MotionGoal(goal::StopMove{}),
          MotionGoal(goal::ZeroTorque{}), MotionGoal(goal::SpeedLevel{1}),
          MotionGoal(goal::SetFsm{1}), MotionGoal(goal::SetFsm{0})}) {
      EXPECT_EQ(motion_->Ask(goal), MotionVerdict::kTaken);
    }
    Endanger(danger, false);
    Step(1);
    EXPECT_EQ(motion_->Ask(goal::StandUp{}), MotionVerdict::kTaken);
  }
}

TEST_F(ProtectionTest, WhileTheChargeIsLowOnlyWhatSparesItIsTaken) {
  input_.soc = rule(Danger::kCharge).limit;  // not below it
  Step(2);
  EXPECT_EQ(does(Danger::kCharge), Protection::kNothing);
  Endanger(Danger::kCharge);
  Step(2);
  for (const MotionGoal& goal :
       {MotionGoal(goal::StandUp{}), MotionGoal(goal::StandDown{}), MotionGoal(goal::ZeroTorque{}),
        MotionGoal(goal::Move{1, 0, 0, 1}), MotionGoal(goal::SetFsm{1})}) {
    EXPECT_EQ(motion_->Ask(goal), MotionVerdict::kNotNow);
  }
  for (const MotionGoal& goal :
       {MotionGoal(goal::Damp{}), MotionGoal(goal::StopMove{}), MotionGoal(goal::RecoveryStand{}),
        MotionGoal(goal::SpeedLevel{1}), MotionGoal(goal::LastingMoves{})}) {
    EXPECT_EQ(motion_->Ask(goal), MotionVerdict::kTaken);
  }
}

TEST_F(ProtectionTest, AJointIsBeyondItsRangeAtEitherEnd) {
  const std::array<double, 2> range = world_.robot().ranges()[2];
  for (const double q : {range[0] - 0.2, range[1] + 0.2}) {
    Make();
    readings_[2].q = q;
    Step(1);
    EXPECT_EQ(does(Danger::kJointEnd), Protection::kWarn) << q;
    const robot::DangerReading told =
        motion_->state().dangers[static_cast<std::size_t>(Danger::kJointEnd)];
    EXPECT_EQ(told.motor, 2);
    EXPECT_NEAR(told.value, 0.2, 1e-9);
  }
}

TEST_F(ProtectionTest, AMotorIsFaultyThatDoesNotAnswerOrWhoseEncoderErrs) {
  for (bool robot::MotorReading::*fault :
       {&robot::MotorReading::silent, &robot::MotorReading::encoder_error}) {
    Make();
    readings_[3].*fault = true;
    Step(1);
    EXPECT_EQ(does(Danger::kMotor), Protection::kDamp);
  }
}

TEST_F(ProtectionTest, ARemoteLedByAnyOfItsSticksMayNotGo) {
  for (double robot::RemoteReading::*stick :
       {&robot::RemoteReading::lx, &robot::RemoteReading::ly, &robot::RemoteReading::rx,
        &robot::RemoteReading::ry}) {
    Make();
    input_.remote = {.there = true};
    input_.remote.*stick = -0.5;
    Step(1);
    input_.remote = {};
    Step(1);
    EXPECT_EQ(does(Danger::kRemote), Protection::kStop);
  }
}

TEST_F(ProtectionTest, AFallIsNoticedOnlyWhereTheServiceTakesItForOne) {
  bare_->stands = false;
  Endanger(Danger::kTilt);
  Step(1);
  EXPECT_EQ(does(Danger::kTilt), Protection::kNothing);
  bare_->stands = true;
  Step(kStep);
  EXPECT_EQ(does(Danger::kTilt), Protection::kDamp);
}

TEST_F(ProtectionTest, AServiceThatKnowsNoFallsIsDamped) {
  bare_->knows_falls = false;
  Endanger(Danger::kTilt);
  Step(2 * kStep);
  EXPECT_EQ(does(Danger::kTilt), Protection::kDamp);
  EXPECT_TRUE(std::holds_alternative<goal::Damp>(bare_->asked.back()));
}

TEST_F(ProtectionTest, ARemoteThatWasNotSteeringMayGo) {
  input_.remote = {.there = true, .keys = 1};
  Step(1);
  input_.remote = {};
  Step(1);
  EXPECT_TRUE(bare_->asked.empty());
}

TEST_F(ProtectionTest, AStartOfTheServiceForgetsWhatWas) {
  Endanger(Danger::kHeat);
  Step(2);
  motion_->Start(input_);
  EXPECT_EQ(does(Danger::kHeat), Protection::kNothing);
  Step(0.9);  // of the second that it takes
  EXPECT_EQ(does(Danger::kHeat), Protection::kNothing);
  Endanger(Danger::kHeat, false);
  input_.remote = {.there = true, .ly = 1};
  Step(1);
  motion_->Start(input_);
  input_.remote = {};
  Step(1);
  EXPECT_EQ(does(Danger::kRemote), Protection::kNothing);
}

TEST(ProtectionSpecTest, TiltIsThatOfTheBaseWhereverTheUnitIs) {
  for (const std::string& robot : test::Robots()) {
    const config::Config config = ConfigOf(robot);
    physics::MujocoWorld world = PhysicsOf(config);
    const Eigen::Vector3d up = world.robot().Imu().R_WI * world.robot().imu_up();
    EXPECT_NEAR(std::acos(std::min(up.z(), 1.0)), world.robot().tilt(), 0.02) << robot;
  }
}

}  // namespace
}  // namespace understudy::motion
