#include "motion/quadruped/gaits.h"

#include <algorithm>
#include <cstddef>

namespace understudy::motion {
namespace {

using authority::goal::GaitName;

constexpr std::array kTrotOffsets{0.0, 0.5, 0.5, 0.0};
constexpr std::array kWalkOffsets{0.0, 0.5, 0.25, 0.75};  // RL, FL, RR, FR lift in turn

// Ids: Go2 motion services V2.0. Types and the modes of a trot: the vendor's page of the older
// firmware. Modes 9, 18, 19: seen on a B2. All else is assumed, the other gaits' modes too: what a
// trained controller's gaits look like is not published.
constexpr std::array kGaits{
    //      gait, name, period, raise, speed, duty, offsets, id, type, standing, moving
    GaitRow{GaitName::kTrot, "trot", 1, 1, 1, 0, kTrotOffsets, 100, 1, 1, 3},
    GaitRow{GaitName::kFree, "FreeWalk", 1, 1, 1, 0, kTrotOffsets, 100, 1, 9, 9},
    GaitRow{GaitName::kStatic, "StaticWalk", 2, 0.8, 0.3, 0.22, kWalkOffsets, 1015, 1, 1, 3},
    GaitRow{GaitName::kRun, "TrotRun", 0.9, 1, 1, 0, kTrotOffsets, 1016, 2, 1, 3},
    GaitRow{GaitName::kEconomic, "EconomicGait", 1.1, 0.7, 0.6, 0, kTrotOffsets, 1017, 1, 1, 3},
    GaitRow{GaitName::kClassic, "ClassicWalk", 1, 1.4, 0.7, 0, kTrotOffsets, 2010, 3, 18, 18},
    GaitRow{GaitName::kFast, "FastWalk", 0.9, 1, 1, 0, kTrotOffsets, 1016, 2, 19, 19},
    GaitRow{GaitName::kStairs, "stairs", 1, 1.6, 0.45, 0, kTrotOffsets, 2010, 3, 18, 18},
};

constexpr std::array kScales{SpeedScale{.range = 0.5, .sticks = 0.5},
                             SpeedScale{.range = 1, .sticks = 1},
                             SpeedScale{.range = 1, .sticks = 1.5}};

}  // namespace

std::span<const GaitRow> GaitRows() { return kGaits; }

const GaitRow& RowOf(GaitName gait) { return kGaits[static_cast<std::size_t>(gait)]; }

SpeedScale ScaleOf(int level) {
  return kScales[static_cast<std::size_t>(std::clamp(level, -1, 1) + 1)];
}

robot::WalkSpec WalkIn(const GaitRow& gait, int level, const robot::WalkSpec& own) {
  const double range = gait.speed * ScaleOf(level).range;
  robot::WalkSpec walk = own;
  for (double& period : walk.period) period *= gait.period;
  for (double& duty : walk.duty) duty += gait.duty;
  walk.foot_raise *= gait.raise;
  walk.least_speed *= range;
  walk.most_speed *= range;
  walk.offsets = gait.offsets;
  return walk;
}

}  // namespace understudy::motion
