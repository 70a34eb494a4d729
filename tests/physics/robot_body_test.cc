// What a robot's body tells of its joints and feet, on a model that one can compute in the head.
#include "physics/robot_body.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

// A wheel of 1 kg·m² with dry and viscous friction on a base that stands on two balls, 3 kg in all;
// the second joint has a range that is not even about 0.
constexpr char kBody[] = R"(
<mujoco>
  <compiler angle="radian"/>
  <option gravity="0 0 -10"/>
  <worldbody>
    <body name="base">
      <freejoint/>
      <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom name="heel" type="sphere" size="0.1" pos="-0.2 0 0"/>
      <geom name="toe" type="sphere" size="0.1" pos="0.2 0 0"/>
      <site name="imu"/>
      <body name="wheel">
        <joint name="wheel_joint" axis="0 0 1" damping="0.5" frictionloss="2" armature="0.25"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      </body>
      <body name="arm">
        <joint name="arm_joint" axis="0 0 1" limited="true" range="-0.5 1.5"/>
        <inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";

class RobotBodyTest : public test::MujocoTest {
 protected:
  static MujocoWorld Make(const Eigen::Vector3d& axis, double yaw = 0) {
    const test::TemporaryFolder folder;
    robot::RobotSpec spec;
    spec.base_body = spec.crane_body = "base";
    spec.imu.site = "imu";
    spec.motors.push_back({.joint = "wheel_joint", .slot = 0});
    spec.motors.push_back({.joint = "arm_joint", .slot = 1});
    spec.feet = {{.name = "foot", .geoms = {"heel", "toe"}, .axis = axis}};
    const PlacedRobot placed{.spec = spec, .file = folder.Write("body.xml", kBody), .yaw = yaw};
    MujocoWorld world(
        LoadWorldModel({placed},
                       folder.Write("scene.xml",
                                    "<mujoco><worldbody><geom type=\"plane\" size=\"9 9 1\"/>"
                                    "</worldbody></mujoco>"),
                       0.001),
        {placed});
    world.robot().Reset({.q = {0, 0}, .height = 0.1});
    return world;
  }
  // One step in which the wheel begins to turn at that rate.
  double FrictionAt(double rate) {
    world_.robot().SetRates(std::vector<double>{rate, 0});
    world_.BeginStep();
    std::vector<double> power(2);
    world_.robot().FrictionPower(power);
    return power[0];
  }
  double FootForce(MujocoWorld* world) {
    for (int i = 0; i < 3000; ++i) {
      world->BeginStep();
      EXPECT_EQ(world->EndStep(), StepHealth::kFine);
    }
    std::vector<double> force(1, 77);
    world->robot().FootForces(force);
    return force[0];
  }

  // Returns the angle [rad] that `torque` turns the wheel by.
  double Turned(double torque, double seconds) {
    const double before = world_.robot().q()[0];
    for (int i = 0; i < std::lround(seconds / 0.001); ++i) {
      world_.BeginStep();
      world_.robot().Drive(std::vector<double>{torque, 0});
      EXPECT_EQ(world_.EndStep(), StepHealth::kFine);
    }
    world_.BeginStep();
    return world_.robot().q()[0] - before;
  }

  MujocoWorld world_ = Make({0, 0, 0});
};

TEST_F(RobotBodyTest, TellsThePowerOfDryAndViscousFrictionEitherWay) {
  EXPECT_NEAR(FrictionAt(3), (2 + 0.5 * 3) * 3, 1e-9);
  EXPECT_NEAR(FrictionAt(-3), (2 + 0.5 * 3) * 3, 1e-9);
  EXPECT_NEAR(FrictionAt(0), 0, 1e-9);
}

TEST_F(RobotBodyTest, TellsNoPowerOfAJointThatIsStuck) {
  world_.robot().Brake(0, 0, RobotBody::Grip::kJammed);
  EXPECT_EQ(FrictionAt(1e-6), 0);
  world_.robot().Brake(0, 0, RobotBody::Grip::kYields);
  EXPECT_NEAR(FrictionAt(3), 10.5, 1e-9);
}

TEST_F(RobotBodyTest, AddsADragToTheFrictionThatAJointHas) {
  world_.robot().Brake(0, 4, RobotBody::Grip::kYields);
  EXPECT_NEAR(FrictionAt(3), (6 + 0.5 * 3) * 3, 1e-9);
}

TEST_F(RobotBodyTest, HoldsAJointThatIsStuckAgainstItsTorqueAndLetsGoOfItAgain) {
  world_.robot().Brake(0, 0, RobotBody::Grip::kJammed);
  EXPECT_LT(std::abs(Turned(50, 0.2)), 1e-4);
  world_.robot().Brake(0, 0, RobotBody::Grip::kYields);
  EXPECT_GT(Turned(50, 0.2), 0.3);
}

TEST_F(RobotBodyTest, AJointThatSticksDoesNotCreepUnderLessThanItsFriction) {
  const double crept = Turned(1.5, 2);
  EXPECT_GT(crept, 1e-3);
  world_.robot().SetRates(std::vector<double>{0, 0});
  world_.robot().Brake(0, 0, RobotBody::Grip::kSticks);
  EXPECT_LT(Turned(1.5, 2), crept / 100);
  EXPECT_GT(Turned(4, 0.2), 0.02) << "more than its friction of 2 N·m turns it";
}

TEST_F(RobotBodyTest, KnowsTheRangesAndArmaturesOfItsJoints) {
  const auto ranges = world_.robot().ranges();
  ASSERT_EQ(ranges.size(), 2U);
  EXPECT_EQ(ranges[0][0], -std::numeric_limits<double>::infinity());
  EXPECT_EQ(ranges[0][1], std::numeric_limits<double>::infinity());
  EXPECT_EQ(ranges[1][0], -0.5);
  EXPECT_EQ(ranges[1][1], 1.5);
  EXPECT_EQ(world_.robot().Armatures(), (std::vector<double>{0.25, 0}));
}

TEST_F(RobotBodyTest, FeelsWhatIsAlongItsFootsAxisOfAllThatTouchesIt) {
  EXPECT_NEAR(FootForce(&world_), 30, 0.1);
  MujocoWorld down = Make({0, 0, -1}), up = Make({0, 0, 1}), aslant = Make({0, 0.6, 0.8}),
              aside = Make({1, 0, 0});
  EXPECT_NEAR(FootForce(&down), 30, 0.1);
  EXPECT_NEAR(FootForce(&up), 30, 0.1);
  EXPECT_NEAR(FootForce(&aslant), 24, 0.1);
  EXPECT_NEAR(FootForce(&aside), 0, 0.1);
}

// Its pose is that of its file, turned with its place about the vertical.
TEST_F(RobotBodyTest, IsPutIntoItsPoseAndThenTurnedAsItIsPlaced) {
  MujocoWorld world = Make({0, 0, 0}, M_PI / 2);
  world.robot().Reset({.q = {0, 0}, .height = 1, .quat = {std::cos(0.25), 0, std::sin(0.25), 0}});
  const Eigen::Vector3d ahead = world.robot().Imu().R_WI * Eigen::Vector3d::UnitX();
  EXPECT_LT((ahead - Eigen::Vector3d(0, std::cos(0.5), -std::sin(0.5))).norm(), 1e-9);
}

TEST_F(RobotBodyTest, RunsBitForBitAsAFreshOneOnceItHasBeenReset) {
  const auto run = [](MujocoWorld* world) {
    world->robot().Reset({.q = {0, 1}, .height = 0.1});
    world->robot().SetRates(std::vector<double>{3, 2});
    for (int i = 0; i < 50; ++i) {
      world->BeginStep();
      EXPECT_EQ(world->EndStep(), StepHealth::kFine);
    }
    return std::vector<double>(world->data().qpos, world->data().qpos + world->model().nq);
  };
  MujocoWorld used = Make({0, 0, 0}), fresh = Make({0, 0, 0});
  used.robot().SetRates(std::vector<double>{-20, -20});
  FootForce(&used);
  EXPECT_EQ(run(&used), run(&fresh));
}

}  // namespace
}  // namespace understudy::physics
