#include "perception/lidar_law.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include <gmock/gmock.h>

namespace understudy::perception {
namespace {

TEST(LidarLawTest, LooksAlongUnitVectorsAsOftenAsItSays) {
  for (const LidarLaw& law : LidarLaws()) {
    SCOPED_TRACE(law.make);
    std::int64_t samples = 0;
    for (std::int64_t slot = 0; slot < law.cloud_slots; ++slot) {
      const double length = law.look(slot).norm();
      if (length == 0) continue;
      ASSERT_NEAR(length, 1, 1e-12);
      ++samples;
    }
    EXPECT_EQ(samples, law.cloud_samples);
  }
}

TEST(LidarLawTest, KeepsAnL1AndAnL2OverTheirHorizon) {
  for (const std::string_view make : {"L1", "L2"}) {
    const LidarLaw& law = LawOf(make);
    for (std::int64_t slot = 0; slot < law.cloud_slots; ++slot) {
      ASSERT_GE(law.look(slot).z(), 0) << make;
    }
  }
}

TEST(LidarLawTest, KeepsAMid360BetweenItsLimitsAndFillsThemInASecond) {
  const LidarLaw& law = LawOf("Mid-360");
  constexpr double kDegree = std::numbers::pi / 180;
  double lowest = 90, highest = -90;
  std::set<std::pair<int, int>> cells;  // of 3 by 3 degrees
  for (std::int64_t slot = 0; slot < law.slots_per_second; ++slot) {
    const Eigen::Vector3d ahead = law.look(slot);
    const double up = std::asin(ahead.z()) / kDegree;
    lowest = std::min(lowest, up);
    highest = std::max(highest, up);
    cells.emplace(static_cast<int>((up + 7) / 3),
                  static_cast<int>((std::atan2(ahead.y(), ahead.x()) / kDegree + 180) / 3));
  }
  EXPECT_NEAR(lowest, -7, 0.1);
  EXPECT_NEAR(highest, 52, 0.1);
  EXPECT_GT(cells.size(), 19U * 119U) << "of 20 by 120";
}

TEST(LidarLawTest, RepeatsNoneOfFourHundredClouds) {
  for (const LidarLaw& law : LidarLaws()) {
    for (std::int64_t cloud = 1; cloud < 400; ++cloud) {
      const std::int64_t slot = law.cloud_slots * cloud;
      EXPECT_FALSE((law.look(slot + 7) - law.look(7)).norm() < 1e-9 &&
                   (law.look(slot + 67) - law.look(67)).norm() < 1e-9)
          << law.make << " " << cloud;
    }
  }
}

}  // namespace
}  // namespace understudy::perception
