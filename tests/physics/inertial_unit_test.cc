#include "physics/inertial_unit.h"

#include <algorithm>
#include <cstring>
#include <fstream>
#include <iterator>
#include <string>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/physics/kicks.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

class InertialUnitTest : public test::MujocoTest {};

// A robot that falls, lands and kicks about, with a unit at its base and one, upside down, on a
// joint.
TEST_F(InertialUnitTest, FeelsBitForBitWhatMujocosSensorsDo) {
  const test::TemporaryFolder folder;
  const robot::RobotSpec spec = test::FixtureRobot();
  std::ifstream file(spec.model);
  std::string text{std::istreambuf_iterator<char>(file), {}};
  text.insert(text.rfind("</mujoco>"), R"(
      <sensor>
        <gyro site="imu"/><accelerometer site="imu"/>
        <gyro site="head_imu"/><accelerometer site="head_imu"/>
      </sensor>)");
  const auto scene = folder.Write("ground.xml", R"(<mujoco><worldbody>
      <geom type="plane" size="0 0 1" contype="0" conaffinity="1"/></worldbody></mujoco>)");
  MujocoWorld world(LoadWorldModel({{spec, folder.Write("robot.xml", text)}}, scene, 0.001),
                    {{spec}});
  world.robot().Reset({.q = spec.standing.q, .height = 0.35});

  const mjcf::ModelHandle model(mj_copyModel(nullptr, &world.model()));
  model->opt.disableflags &= ~mjDSBL_SENSOR;
  const mjcf::DataHandle whole(mj_copyData(nullptr, model.get(), &world.data()));
  const int first = model->sensor_adr[model->nsensor - 4];
  double most = 0;
  for (int step = 0; step < 1000; ++step) {
    ASSERT_NO_FATAL_FAILURE(Kick(step, &world, *model, whole.get()));
    const mjtNum* felt = whole->sensordata + first;
    for (const robot::ImuReading& unit : {world.robot().Imu(), world.robot().SecondaryImu()}) {
      ASSERT_EQ(std::memcmp(felt, unit.w_WI_I.data(), 3 * sizeof(double)), 0) << step;
      ASSERT_EQ(std::memcmp(felt + 3, unit.f_WI_I.data(), 3 * sizeof(double)), 0) << step;
      felt += 6;
    }
    most = std::max(most, world.robot().SecondaryImu().f_WI_I.norm());
  }
  EXPECT_GT(most, 50);  // it did land
}

TEST_F(InertialUnitTest, WithoutASiteReadsNothing) {
  const test::TemporaryFolder folder;
  robot::RobotSpec spec = test::FixtureRobot();
  spec.imu.secondary_site.clear();
  const auto scene = folder.Write("space.xml", "<mujoco><worldbody/></mujoco>");
  MujocoWorld world(LoadWorldModel({{spec, spec.model}}, scene, 0.001), {{spec}});
  world.BeginStep();
  ASSERT_EQ(world.EndStep(), StepHealth::kFine);
  EXPECT_EQ(world.robot().SecondaryImu().f_WI_I.norm(), 0);
  EXPECT_EQ(world.robot().SecondaryImu().w_WI_I.norm(), 0);
}

}  // namespace
}  // namespace understudy::physics
