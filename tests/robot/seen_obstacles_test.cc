#include "robot/seen_obstacles.h"

#include <gmock/gmock.h>

namespace understudy::robot {
namespace {

using testing::ElementsAre;

TEST(SeenObstaclesTest, HasRangesAheadRightBehindAndLeft) {
  SeenObstacles seen;
  EXPECT_THAT(RangesOf(seen), ElementsAre(2, 2, 2, 2));
  for (const Eigen::Vector2d& at : {Eigen::Vector2d(0.9, 0.1),
                                    {1.2, 0},
                                    {0.1, -0.7},
                                    {-0.6, 0},
                                    {0, 0.8},
                                    {0.5, 0.5},
                                    {3, 0}}) {
    seen.points[seen.count++] = at;
  }
  EXPECT_THAT(RangesOf(seen), ElementsAre(0.9, 0.7, 0.6, 0.8));
}

}  // namespace
}  // namespace understudy::robot
