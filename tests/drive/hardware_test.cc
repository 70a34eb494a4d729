// The hardware of the fixture robot, clamped in the air, without a computer.
#include "drive/hardware.h"

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "physics/mujoco_world.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::drive {
namespace {

class HardwareTest : public test::MujocoTest {
 protected:
  static robot::RobotCommand Torque(double tau) {
    return {.motors = std::vector<robot::MotorCommand>(6, {.enabled = true, .tau = tau})};
  }
  // Makes the hardware of spec_ and clamps the robot.
  void Start() {
    hardware_.emplace(spec_, sensors::SensorConfig{.quantise = false, .noise = false}, faults_,
                      Torque(0), &body(), world_.timestep());
    hardware_->Restart(Torque(0), spec_.hanging);
    body().Clamp(true);
  }
  void Step(const robot::RobotCommand& command, int times = 1) {
    for (int i = 0; i < times; ++i) {
      faults_.Step(t_);
      hardware_->Send(command, t_);
      world_.BeginStep();
      hardware_->Act();
      ASSERT_EQ(world_.EndStep(), physics::StepHealth::kFine);
      hardware_->Sense();
      t_ += world_.timestep();
    }
  }
  double torque() const { return hardware_->motors().torque()[0]; }
  physics::RobotBody& body() { return world_.robot(0); }
  void Begin(const std::string& component, const char* kind, double by) {
    ASSERT_TRUE(faults_.Begin(component, kind, by == 0 ? nullptr : &by, {}, t_));
  }

  robot::RobotSpec spec_ = [] {
    robot::RobotSpec spec = test::FixtureRobot();
    spec.buses = {{.name = "leg", .slots = {0}}};
    return spec;
  }();
  physics::MujocoWorld world_ = test::FixtureWorld(spec_, 0.001);
  robot::FaultBank faults_{spec_, {}, {}, 1};
  std::optional<Hardware> hardware_;
  double t_ = 0;
};

TEST_F(HardwareTest, DrivesTheJointsAsTheCommandSays) {
  Start();
  Step(Torque(3));
  EXPECT_EQ(torque(), 3);
  EXPECT_EQ(hardware_->command().motors, Torque(3).motors);
}

TEST_F(HardwareTest, SwitchedOffGivesNoTorqueAndTakesNoCommand) {
  Start();
  Step(Torque(3));
  hardware_->SwitchOff();
  Step(Torque(3), 10);
  EXPECT_EQ(torque(), 0);
  EXPECT_EQ(hardware_->command().motors, std::vector<robot::MotorCommand>(6));
}

TEST_F(HardwareTest, SwitchedOnFollowsNothingThatABusCarriedBefore) {
  Start();
  Begin("bus.leg", "slow", 0.05);
  Step(Torque(3));
  hardware_->SwitchOff();
  Step(Torque(0));
  ASSERT_TRUE(hardware_->SwitchOn());
  for (int i = 0; i < 100; ++i) {
    Step(Torque(0));
    ASSERT_EQ(torque(), 0) << i;
  }
}

TEST_F(HardwareTest, SwitchedOnHoldsNoJointThatWasPosedBefore) {
  Start();
  hardware_->MoveJoint(0, 1, 100);
  Step(Torque(0), 100);
  ASSERT_NE(torque(), 0);
  hardware_->SwitchOff();
  ASSERT_TRUE(hardware_->SwitchOn());
  Step(Torque(0));
  EXPECT_EQ(torque(), 0);
}

// Its friction carries the leg, which stands out a little, but would yield to it slowly.
TEST_F(HardwareTest, AJointWithALimpMotorSticksThoughItIsAskedToMove) {
  spec_.hanging.q[0] = 0.1;
  Start();
  Begin("FR_joint", "dragging", 5);
  Begin("FR_joint", "limp", 0);
  robot::RobotCommand asks = Torque(0);
  asks.motors[0] = {.enabled = true, .q = 0, .kp = 200, .kd = 5};
  Step(asks, 2000);
  const double stuck = body().q()[0];
  EXPECT_LT(std::abs(body().dq()[0]), Stiction::kStill);
  Step(asks, 2000);
  EXPECT_NEAR(body().q()[0], stuck, 1e-4);
}

TEST_F(HardwareTest, SwitchedOnItsUnitKnowsHowItLies) {
  hardware_.emplace(
      spec_,
      sensors::SensorConfig{
          .quantise = false, .noise = false, .imu = {.attitude = sensors::AttitudeSource::kFilter}},
      faults_, Torque(0), &body(), world_.timestep());
  hardware_->Restart(Torque(0), spec_.hanging);
  hardware_->SwitchOff();
  for (int i = 0; i < 200; ++i) {  // turned in its fall
    world_.AddForce(body().Body("base"), {0, 0.5, 1}, {0, 0, 30});
    Step(Torque(0));
  }
  ASSERT_GT(body().tilt(), 0.3);
  ASSERT_TRUE(hardware_->SwitchOn());
  robot::RobotState state;
  hardware_->Sample(&state, /*feels=*/false);
  // It turns by 0.01 rad in a step.
  EXPECT_LT(state.imu.R_WI.angularDistance(body().Imu().R_WI), 0.03);
}

TEST_F(HardwareTest, DoesNotSwitchOnAnEmptyBattery) {
  spec_.battery.start_soc = 1e-7;
  Start();
  Step(Torque(0), 100);
  ASSERT_EQ(hardware_->battery().cut_off(), robot::CutOff::kEmpty);
  hardware_->SwitchOff();
  EXPECT_FALSE(hardware_->SwitchOn());
}

}  // namespace
}  // namespace understudy::drive
