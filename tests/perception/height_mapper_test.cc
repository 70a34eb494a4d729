#include "perception/height_mapper.h"

#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "tests/support/allocations.h"

namespace understudy::perception {
namespace {

class HeightMapperTest : public testing::Test {
 protected:
  float At(double x, double y) {
    robot::HeightMap map;
    mapper_.Read(&map);
    const auto cell = [](double at, double from) {
      return static_cast<std::size_t>(std::floor((at - from) / robot::HeightMap::kCell + 1e-9));
    };
    return map.heights.at(cell(y, map.origin.y()) * robot::HeightMap::kCells +
                          cell(x, map.origin.x()));
  }

  HeightMapper mapper_;
};

TEST_F(HeightMapperTest, HasTheRobotInTheMiddleAndNothingBeforeItSees) {
  mapper_.Follow({1, -2});
  robot::HeightMap map;
  mapper_.Read(&map);
  ASSERT_EQ(map.heights.size(), 128U * 128U);
  EXPECT_NEAR(map.origin.x() + 64 * 0.06, 1, 0.061);
  EXPECT_NEAR(map.origin.y() + 64 * 0.06, -2, 0.061);
  for (const float height : map.heights) ASSERT_EQ(height, 1e9F);
}

TEST_F(HeightMapperTest, HasTheHeightOfAStepWhereItStands) {
  mapper_.Follow({0, 0});
  for (double x = -1; x < 1; x += 0.02) mapper_.Add({x, 0.03, x < 0.3 ? 0 : 0.16});
  EXPECT_EQ(At(0.03, 0.03), 0);
  EXPECT_EQ(At(0.45, 0.03), 0.16F);
  EXPECT_EQ(At(0.03, 0.2), 1e9F);
}

TEST_F(HeightMapperTest, AveragesNoiseAndKeepsTheTopOfAWall) {
  mapper_.Follow({0, 0});
  for (int i = 0; i < 200; ++i) mapper_.Add({0.03, 0.03, 0.1 + (i % 2 == 0 ? 0.02 : -0.02)});
  EXPECT_NEAR(At(0.03, 0.03), 0.1, 0.01);
  mapper_.Add({0.03, 0.03, 1});
  mapper_.Add({0.03, 0.03, 0.4});
  EXPECT_EQ(At(0.03, 0.03), 1);
}

TEST_F(HeightMapperTest, MovesWithTheRobotAndForgetsWhatItLeaves) {
  mapper_.Follow({0, 0});
  mapper_.Add({-3.5, 0, 0.5});
  mapper_.Add({3, 0, 0.25});
  mapper_.Follow({1, 0.5});
  EXPECT_EQ(At(3.01, 0.01), 0.25F) << "it stays where it is in odom";
  mapper_.Follow({0, 0});
  EXPECT_EQ(At(-3.49, 0.01), 1e9F) << "it was outside";
  mapper_.Add({100, 0, 1});  // outside
  mapper_.Clear();
  EXPECT_EQ(At(3.01, 0.01), 1e9F);
}

TEST_F(HeightMapperTest, AllocatesNothing) {
  robot::HeightMap map;
  mapper_.Read(&map);
  const std::uint64_t before = test::Allocations();
  mapper_.Follow({5, 5});
  mapper_.Add({5, 5, 1});
  mapper_.Read(&map);
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace understudy::perception
