// Checks that Balance Stand holds the body level and at its height on any ground.

#include <filesystem>
#include <string>
#include <utility>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"
#include "tests/support/temporary_folder.h"

namespace understudy::motion {
namespace {

class QuadrupedGroundTest : public testing::TestWithParam<std::string> {
 protected:
  // A plane whose height grows by these slopes along x and y.
  std::filesystem::path Slope(double x, double y) {
    return folder_.Write("slope.xml",
                         "<mujoco><worldbody><geom type='plane' size='0 0 1' condim='3' "
                         "friction='0.8 0.005 0.0001' zaxis='" +
                             std::to_string(-x) + " " + std::to_string(-y) +
                             " 1'/></worldbody></mujoco>");
  }

  test::TemporaryFolder folder_;
};

TEST_P(QuadrupedGroundTest, HoldsTheBodyLevelOnASlope) {
  for (const auto& [x, y] : {std::pair(0.14, 0.0), std::pair(-0.14, 0.0), std::pair(0.07, 0.1)}) {
    QuadrupedRig rig(GetParam(), {}, Slope(x, y));
    rig.StandUp();
    EXPECT_GT(rig.tilt(), 4 * kDegree) << "a lock stands as the ground does";
    rig.Ask(goal::BalanceStand{});
    rig.Run(3);
    EXPECT_LT(rig.tilt(), 1.5 * kDegree) << x << " " << y;
    EXPECT_NEAR(rig.state().body_height, rig.spec().motion.quadruped.stand_height, 0.015);
    const Eigen::Vector3d before = rig.world().robot().base().p_WB;
    rig.Run(2);
    EXPECT_LT((rig.world().robot().base().p_WB - before).norm(), 0.03) << "stays in its place";
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedGroundTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
