#include <cstring>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "physics/world_model.h"
#include "tests/physics/kicks.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

// The step in two halves with the torque set between them, against mj_step with the same torque
// set before. The robot falls, lands and kicks about, contacts included.
class SplitStepTest : public test::MujocoTest, public testing::WithParamInterface<const char*> {};

TEST_P(SplitStepTest, EqualsTheWholeStepBitForBit) {
  const test::TemporaryFolder folder;
  const robot::RobotSpec spec = test::FixtureRobot();
  const auto scene =
      folder.Write("ground.xml", std::string(R"(<mujoco><option integrator=")") + GetParam() +
                                     R"("/><worldbody><geom type="plane" size="0 0 1"
                                         contype="0" conaffinity="1"/></worldbody></mujoco>)");
  MujocoWorld world(LoadWorldModel({{spec, spec.model}}, scene, 0.001), {{spec}});
  world.robot().Reset({.q = spec.standing.q, .height = 0.35});

  const mjcf::ModelHandle model(mj_copyModel(nullptr, &world.model()));
  const mjcf::DataHandle whole(mj_copyData(nullptr, model.get(), &world.data()));
  int contacts = 0;
  for (int step = 0; step < 1000; ++step) {
    ASSERT_NO_FATAL_FAILURE(Kick(step, &world, *model, whole.get()));
    const auto size = [](auto n) { return sizeof(mjtNum) * static_cast<std::size_t>(n); };
    ASSERT_EQ(std::memcmp(whole->qpos, world.data().qpos, size(model->nq)), 0) << step;
    ASSERT_EQ(std::memcmp(whole->qvel, world.data().qvel, size(model->nv)), 0) << step;
    contacts += whole->ncon;
  }
  EXPECT_GT(contacts, 0);
}

INSTANTIATE_TEST_SUITE_P(Integrators, SplitStepTest, testing::Values("Euler", "implicit"),
                         [](const auto& test) { return std::string(test.param); });

}  // namespace
}  // namespace understudy::physics
