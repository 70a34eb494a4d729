#include "perception/nearest_obstacle.h"

#include <string>

#include <gtest/gtest.h>

#include "assembly/simulation.h"
#include "config/load.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::perception {
namespace {

class NearestObstacleTest : public test::MujocoTest {
 protected:
  // How far a box ahead is from a Go2 that stands: its face is at x [m], it is so high [m].
  double Of(double x, double high, const std::string& pose = "standing") {
    const test::TemporaryFolder folder;
    const std::string half = std::to_string(high / 2);
    const std::string scene =
        folder
            .Write("box.xml",
                   "<mujoco><worldbody><geom type='plane' size='0 0 1'/><geom type='box' "
                   "size='0.1 0.1 " +
                       half + "' pos='" + std::to_string(x + 0.1) + " 0 " + half +
                       "'/></worldbody></mujoco>")
            .string();
    assembly::Simulation simulation(config::LoadConfig(
        {.robot = "go2", .sets = {"scene=" + scene, "start.pose=" + pose}}, UNDERSTUDY_SOURCE_DIR));
    simulation.Step(2);
    const physics::MujocoWorld& world = simulation.world().physics();
    NearestObstacle nearest(world, 0);
    return nearest.Measure(1, world.data());
  }
};

TEST_F(NearestObstacleTest, IsTheDistanceFromTheNose) {
  EXPECT_NEAR(Of(1.335, 1), 1, 0.02);
  EXPECT_NEAR(Of(0.435, 1), 0.1, 0.02);
}

TEST_F(NearestObstacleTest, IsAtMostTenMetres) { EXPECT_EQ(Of(30, 1), NearestObstacle::kFarthest); }

TEST_F(NearestObstacleTest, LeavesOutWhatIsLowerThanTheBase) {
  EXPECT_EQ(Of(1, 0.1), NearestObstacle::kFarthest);
}

}  // namespace
}  // namespace understudy::perception
