// Balance Stand holds the body level whatever the ground, at its height over it.

#include <cmath>
#include <fstream>
#include <string>

#include <gtest/gtest.h>

#include "tests/motion/quadruped_rig.h"
#include "tests/support/temporary_folder.h"

namespace understudy {
namespace {

constexpr double kDegree = 0.017453;  // rad

class QuadrupedGroundTest : public testing::TestWithParam<const char*> {
 protected:
  // A plane turned by roll and pitch [degrees].
  std::filesystem::path Slope(double roll, double pitch) {
    const std::filesystem::path file = folder_.path() / "slope.xml";
    std::ofstream(file) << "<mujoco><worldbody><geom type='plane' size='0 0 1' condim='3' "
                           "friction='0.8 0.005 0.0001' euler='"
                        << roll << " " << pitch << " 0'/></worldbody></mujoco>";
    return file;
  }

  TemporaryFolder folder_;
};

TEST_P(QuadrupedGroundTest, HoldsTheBodyLevelOnASlope) {
  for (const auto& [roll, pitch] :
       {std::pair(0.0, 8.0), std::pair(0.0, -8.0), std::pair(6.0, 4.0)}) {
    QuadrupedRig rig(GetParam(), {}, Slope(roll, pitch));
    rig.StandUp();
    EXPECT_GT(rig.tilt(), 4 * kDegree) << "a lock stands as the ground does";
    rig.Ask(MotionAction::kBalanceStand);
    rig.Run(3);
    EXPECT_LT(rig.tilt(), 1.5 * kDegree) << roll << " " << pitch;
    EXPECT_NEAR(rig.state().body_height, rig.spec().motion.quadruped.stand_height, 0.015);
    const Eigen::Vector3d before = rig.world().base().p_WB;
    rig.Run(2);
    EXPECT_LT((rig.world().base().p_WB - before).norm(), 0.03) << "stays in its place";
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedGroundTest,
                         testing::Values("go2", "go2w", "b2", "b2w", "a2"),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy
