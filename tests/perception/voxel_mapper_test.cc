#include "perception/voxel_mapper.h"

#include <bit>
#include <cmath>
#include <cstddef>

#include <gtest/gtest.h>

#include "tests/support/allocations.h"

namespace understudy::perception {
namespace {

class VoxelMapperTest : public testing::Test {
 protected:
  // Whether the cube around a point is full.
  bool At(double x, double y, double z) {
    mapper_.Read(&map_);
    const Eigen::Vector3d cube = (Eigen::Vector3d(x, y, z) - map_.origin) / 0.05;
    const auto place = [&cube](int axis) {
      return static_cast<std::size_t>(std::floor(cube[axis] + 0.5));
    };
    const std::size_t row = (place(2) * 128 + place(1)) * 16;
    return (map_.bits.at(row + place(0) / 8) >> (7 - place(0) % 8) & 1) != 0;
  }
  int Full() {
    mapper_.Read(&map_);
    int full = 0;
    for (const std::uint8_t bits : map_.bits) full += std::popcount(bits);
    return full;
  }

  VoxelMapper mapper_;
  robot::VoxelMap map_;
};

TEST_F(VoxelMapperTest, HasTheRobotInTheMiddleAndNothingBeforeItSees) {
  EXPECT_EQ(Full(), 0);
  EXPECT_EQ(map_.bits.size(), 77824U) << "src_size of real ones";
  mapper_.Begin({1, -2});
  EXPECT_EQ(Full(), 0);
  EXPECT_NEAR(map_.origin.x() + 64 * 0.05, 1, 0.051);
  EXPECT_NEAR(map_.origin.y() + 64 * 0.05, -2, 0.051);
  EXPECT_DOUBLE_EQ(map_.origin.z(), -0.575) << "of real ones on level ground";
  EXPECT_NEAR(std::remainder(map_.origin.x() - 0.025, 0.05), 0, 1e-9) << "as real ones' -3.625";
}

TEST_F(VoxelMapperTest, FillsTheCubeOfAnEchoWhereverTheRobotIs) {
  for (const double base : {-50.0, -0.01, 0.0, 0.03, 3.21, 6.4, 1000.0}) {
    mapper_.Clear();
    mapper_.Begin({base, -base});
    for (const double off : {-3.1317, -0.3317, 0.0217, 1.6117, 3.1117}) {
      mapper_.Add({base + off, -base + off / 2, off / 10});
    }
    EXPECT_EQ(Full(), 5) << base;
    for (const double off : {-3.1317, -0.3317, 0.0217, 1.6117, 3.1117}) {
      EXPECT_TRUE(At(base + off, -base + off / 2, off / 10)) << base << ", " << off;
    }
  }
}

TEST_F(VoxelMapperTest, LeavesOutWhatIsOutside) {
  mapper_.Begin({0, 0});
  mapper_.Add({3.3, 0, 0});
  mapper_.Add({0, -3.3, 0});
  mapper_.Add({0, 0, 1.31});
  mapper_.Add({0, 0, -0.61});
  EXPECT_EQ(Full(), 0);
  mapper_.Add({0, 0, 1.29});
  mapper_.Add({0, 0, -0.59});
  EXPECT_EQ(Full(), 2);
}

TEST_F(VoxelMapperTest, MovesWithTheRobotAndForgetsWhatItLeaves) {
  mapper_.Begin({0, 0});
  mapper_.Add({-3, 0.01, 0.5});
  mapper_.Add({0.01, -3, 0.5});
  mapper_.Add({3, 3, 0.5});
  mapper_.Begin({1, 0.5});
  EXPECT_TRUE(At(3, 3, 0.5)) << "it stays where it is in odom";
  EXPECT_EQ(Full(), 1);
  mapper_.Begin({0, 0});
  EXPECT_EQ(Full(), 1) << "the others were outside";
}

TEST_F(VoxelMapperTest, EmptiesWhatIsNotSeenAgain) {
  mapper_.Begin({0, 0});
  mapper_.Add({1, 0, 0.5});
  mapper_.Add({1, 1, 0.5});
  for (int cloud = 0; cloud < 100; ++cloud) {
    mapper_.Begin({0, 0});
    mapper_.Add({1, 1, 0.5});
    if (cloud == 30) {
      EXPECT_TRUE(At(1, 0, 0.5)) << "two seconds later";
    }
  }
  EXPECT_FALSE(At(1, 0, 0.5));
  EXPECT_TRUE(At(1, 1, 0.5));
}

TEST_F(VoxelMapperTest, AllocatesAtTheFirstCloudOnly) {
  mapper_.Begin({0, 0});
  mapper_.Read(&map_);
  const std::uint64_t before = test::Allocations();
  mapper_.Begin({5, 5});
  mapper_.Add({5, 5, 1});
  mapper_.Read(&map_);
  EXPECT_EQ(test::Allocations(), before);
}

}  // namespace
}  // namespace understudy::perception
