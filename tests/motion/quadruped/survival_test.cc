// A part of what tools/survival counts (docs/dev/walking.md).
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/trial.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

class SurvivalTest : public testing::TestWithParam<std::string> {
 protected:
  static Trial TrialOn(const std::string& ground, int seed) {
    const double push = ground == "stairs" ? 0 : PushOf(test::ShippedRobot(GetParam()));
    return {GetParam(), ground, push, seed};
  }
};

TEST_P(SurvivalTest, KeepsOnItsFeetOrGetsUpAgain) {
  int fell = 0;
  for (const char* ground : {"rest", "flat", "rough", "slope", "stairs"}) {
    for (const int seed : {1001, 1002}) {
      const Outcome outcome = Try(TrialOn(ground, seed));
      if (outcome.fell < 0) continue;
      ++fell;
      EXPECT_TRUE(outcome.righted) << ground << " " << seed;
    }
  }
  EXPECT_LE(fell, 1) << "of ten";
}

TEST_P(SurvivalTest, IsTheSameAgainFromTheSameSeed) {
  const auto walk = [] {
    std::vector<double> way;
    Try(TrialOn("flat", 1003), [&](const MotionRig& rig, double, const Eigen::Vector3d&) {
      const Eigen::Vector3d& p = rig.world().robot().base().p_WB;
      way.insert(way.end(), {p.x(), p.y(), p.z()});
    });
    return way;
  };
  EXPECT_EQ(walk(), walk()) << "bit for bit";
}

INSTANTIATE_TEST_SUITE_P(Robots, SurvivalTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
