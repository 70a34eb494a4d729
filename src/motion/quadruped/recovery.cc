#include "motion/quadruped/recovery.h"

#include <algorithm>
#include <array>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// All assumed.
constexpr double kUpright = 0.8;  // cosine of the tilt from which the legs alone lift the robot
constexpr double kOnBack = -0.6;
constexpr double kFoldTime = 0.8;     // s
constexpr double kFoldRest = 0.6;     // s until it lies still
constexpr double kSwingRest = 0.05;   // s
constexpr double kFoldedThigh = 1.3;  // rad
constexpr double kStopMargin = 0.03;  // rad kept from the ends of a joint's range

// Angles of a leg: hip outwards, thigh, calf. Beyond the range of a joint is at its end.
struct Sides {
  Vector3d lower, higher;
};
struct Push {
  Sides swing, push;
  double swing_time, push_time, rest;  // s
};

// Found by a random search in simulation, from the back and the side: derived from our models, like
// nothing that was seen on a robot. The first way gets all but the Go2-W over, the second all but
// the B2-W.
constexpr double kFolded = -3, kWide = 1.5;
constexpr std::size_t kPushesEach = 3;
const std::array<Push, 2> kFromBack{
    Push{.swing = {.lower = {-1.11, 1.76, -1.96}, .higher = {-kWide, 4.63, kFolded}},
         .push = {.lower = {0.05, 1.73, -2.67}, .higher = {1.09, 3.32, 0}},
         .swing_time = 0.25,
         .push_time = 0.15,
         .rest = 0.44},
    Push{.swing = {.lower = {-0.73, 1.46, -2.23}, .higher = {-1.13, 3.32, kFolded}},
         .push = {.lower = {kWide, 1.57, -2.4}, .higher = {kWide, 3.5, -0.52}},
         .swing_time = 0.25,
         .push_time = 0.18,
         .rest = 0.4}};
const std::array<Push, 2> kFromSide{
    Push{.swing = {.lower = {-1.04, 3.07, kFolded}, .higher = {0.69, 1.74, -0.71}},
         .push = {.lower = {0.89, 3.35, -1.49}, .higher = {-0.47, 0.9, -1.46}},
         .swing_time = 0.24,
         .push_time = 0.32,
         .rest = 0.44},
    Push{.swing = {.lower = {-1.04, 3.03, kFolded}, .higher = {0.76, 0.09, -0.97}},
         .push = {.lower = {1.15, 2.92, -2.5}, .higher = {-0.51, 0.1, 0}},
         .swing_time = 0.47,
         .push_time = 0.25,
         .rest = 0.4}};

// From the back it takes two pushes, over the side: so a way has several before its turn ends.
const Push& Way(bool on_back, std::size_t pushes) {
  const auto& ways = on_back ? kFromBack : kFromSide;
  return ways[pushes / kPushesEach % ways.size()];
}

bool IsRight(std::size_t leg) { return leg % 2 == 0; }

}  // namespace

void QuadrupedRecovery::Begin(const QuadrupedReading& reading) {
  pushes_ = 0;
  Enter(Phase::kFold, reading);
}

PerLeg QuadrupedRecovery::Goal(Phase phase) const {
  const Push& way = Way(on_back_, pushes_);
  PerLeg goal;
  for (std::size_t leg = 0; leg < goal.size(); ++leg) {
    const LegFigures& figures = body_.leg(leg).figures();
    Vector3d q(0, kFoldedThigh, kFolded);
    if (phase != Phase::kFold) {
      const Sides& sides = phase == Phase::kSwing ? way.swing : way.push;
      q = IsRight(leg) == right_down_ ? sides.lower : sides.higher;
      if (IsRight(leg)) q[0] = -q[0];
    }
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      goal[leg][i] =
          std::clamp(q[i], figures.low[at] + kStopMargin, figures.high[at] - kStopMargin);
    }
  }
  return goal;
}

void QuadrupedRecovery::Enter(Phase phase, const QuadrupedReading& reading) {
  const Push& way = Way(on_back_, pushes_);
  const double time = phase == Phase::kFold    ? kFoldTime
                      : phase == Phase::kSwing ? way.swing_time
                                               : way.push_time;
  const double rest = phase == Phase::kFold    ? kFoldRest
                      : phase == Phase::kSwing ? kSwingRest
                                               : way.rest;
  phase_ = phase;
  left_ = time + rest;
  move_.Begin(reading, Goal(phase), time);
}

void QuadrupedRecovery::EnterNext(const QuadrupedReading& reading) {
  switch (phase_) {
    case Phase::kFold:
      if (reading.up.z() > kUpright) {
        phase_ = Phase::kOver;
        break;
      }
      on_back_ = reading.up.z() < kOnBack;
      right_down_ = reading.up.y() > 0;
      Enter(Phase::kSwing, reading);
      break;
    case Phase::kSwing:
      Enter(Phase::kPush, reading);
      break;
    case Phase::kPush:
      ++pushes_;
      Enter(Phase::kFold, reading);
      break;
    case Phase::kOver:
      break;
  }
}

void QuadrupedRecovery::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  left_ -= dt;
  move_.Step(sensed, dt, legs);
  if (left_ > 0) return;
  EnterNext(sensed);
  move_.Step(sensed, 0, legs);
}

}  // namespace understudy::motion
