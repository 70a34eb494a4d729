#include "rehearse/lidar_view.h"

#include <gmock/gmock.h>

namespace understudy::rehearse {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

// Enough ground 2 m behind the robot that one point more is not below it.
LidarView WithGround(LidarView points) {
  for (int i = 0; i < 100; ++i) points.emplace_back(-2, 0, -0.3F);
  return points;
}

TEST(DrawLidarViewTest, HasWhatIsAheadAboveTheRobotAndWhatIsToItsLeftOnTheLeft) {
  // 320 pixels for 8 m: 1 m is 40.
  const std::string ahead = DrawLidarView(WithGround({{0.99F, -0.01F, 0}}));
  EXPECT_THAT(ahead, HasSubstr("<path class=\"height2\" d=\"M160 121h2\"/>"));
  const std::string left = DrawLidarView(WithGround({{-0.01F, 1.99F, 0}}));
  EXPECT_THAT(left, HasSubstr("<path class=\"height2\" d=\"M80 161h2\"/>"));
}

TEST(DrawLidarViewTest, ColoursByTheHighestPointOverTheGround) {
  const std::string svg = DrawLidarView(WithGround({{1, 1, -0.25F}, {1, 1, 1.6F}, {1, 1, 0.4F}}));
  EXPECT_THAT(svg, HasSubstr("class=\"height0\""));  // the ground
  EXPECT_THAT(svg, HasSubstr("class=\"height5\""));
  EXPECT_THAT(svg, Not(HasSubstr("class=\"height3\"")));
}

TEST(DrawLidarViewTest, LeavesOutWhatIsTooFar) {
  EXPECT_THAT(DrawLidarView(WithGround({{4.1F, 0, 1}, {0, -4.1F, 1}, {1e9F, 0, 1}})),
              Not(HasSubstr("class=\"height4\"")));
  EXPECT_THAT(DrawLidarView({}), HasSubstr("class=\"robot\""));
}

}  // namespace
}  // namespace understudy::rehearse
