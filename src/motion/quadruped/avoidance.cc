#include "motion/quadruped/avoidance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace understudy::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// All *assumed*.
constexpr double kBodyAhead = 0.36, kBodyBehind = 0.30,
                 kBodyAside = 0.17;       // m, a Go2's outline with its legs
constexpr double kCorridorMargin = 0.08;  // m on each side of the corridor
constexpr double kStopBefore = 0.4;       // m before an obstacle where it stands
constexpr double kStopTime = 1.0;         // s in which it would come there
constexpr double kSureSight = 2.1;        // m: as far as it is sure to see
constexpr double kPastObstacle = 0.5;     // m beyond an obstacle that a way round it must lead
constexpr double kRoundSpeed = 0.4;       // m/s
constexpr double kFirstCloud = 0.3;       // s for the first cloud
constexpr double kKeepsSide = 1.5;        // s that it keeps to a side
constexpr double kRoundTurns[] = {0.26, 0.52, 0.79};  // rad from its way: 15° to 45°

double OutlineTo(const Vector2d& along) {
  return (along.x() > 0 ? kBodyAhead : kBodyBehind) * std::abs(along.x()) +
         kBodyAside * std::abs(along.y());
}

// How fast [m/s] it goes where so much of its way is free [m].
double SpeedBefore(double free) { return std::max(0.0, (free - kStopBefore) / kStopTime); }

}  // namespace

double FreeWay(const Vector2d& along, const robot::SeenObstacles& seen) {
  const Vector2d aside(-along.y(), along.x());
  const double front = OutlineTo(along), left = OutlineTo(aside), right = OutlineTo(-aside);
  double free = kSureSight;
  for (const Vector2d& point : seen.all()) {
    const double ahead = along.dot(point), off = aside.dot(point);
    // What is beside the body is not met by going on.
    const double margin = ahead > front ? kCorridorMargin : 0;
    if (ahead <= 0 || off > left + margin || off < -right - margin) continue;
    free = std::min(free, std::max(0.0, ahead - front));
  }
  return free;
}

void Avoidance::Rest() { waited_ = side_ = straight_ = 0; }

Vector3d Avoidance::Limit(const Vector3d& wish, const robot::SeenObstacles& seen, double dt) {
  const double speed = wish.head<2>().norm();
  if (!seen.known) {
    waited_ += dt;
    return waited_ > kFirstCloud ? wish : Vector3d(0, 0, wish.z());
  }
  straight_ += dt;
  if (straight_ > kKeepsSide) side_ = 0;
  if (speed == 0) return wish;
  const Vector2d along = wish.head<2>() / speed;
  const double free = FreeWay(along, seen);
  if (free >= kSureSight || SpeedBefore(free) >= speed) return wish;
  Vector2d way = along * std::min(speed, SpeedBefore(free));
  if (const auto round = RoundFrom(along, free, seen)) {
    side_ = round->side;
    straight_ = 0;
    way = std::min({speed, kRoundSpeed, SpeedBefore(round->free)}) * round->along;
  }
  return {way.x(), way.y(), wish.z()};
}

// To the side on which it is already, else to that where it has to turn less; the left of two equal
// ones.
std::optional<Avoidance::Round> Avoidance::RoundFrom(const Vector2d& along, double free,
                                                     const robot::SeenObstacles& seen) const {
  if (!sidesteps_) return std::nullopt;
  std::optional<Round> best;
  for (const double side : {1.0, -1.0}) {
    for (const double turn : kRoundTurns) {
      const Vector2d way = Eigen::Rotation2Dd(side * turn) * along;
      const double around = FreeWay(way, seen);
      if (around * std::cos(turn) < free + kPastObstacle) continue;
      if (side == side_) return Round{side, turn, around, way};
      if (!best || turn < best->turn) best = Round{side, turn, around, way};
      break;
    }
  }
  return best;
}

}  // namespace understudy::motion
