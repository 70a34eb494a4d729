#include "motion/quadruped/avoidance.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace understudy::motion {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// All *assumed*.
constexpr double kAhead = 0.36, kBehind = 0.30, kAside = 0.17;  // m, a Go2's outline with its legs
constexpr double kMargin = 0.08;                                // m on each side of the corridor
constexpr double kStop = 0.4;        // m before an obstacle where it stands
constexpr double kTime = 1.0;        // s in which it would come there
constexpr double kFarthest = 2.1;    // m: as far as it is sure to see
constexpr double kPast = 0.5;        // m beyond an obstacle that a way round it must lead
constexpr double kRoundSpeed = 0.4;  // m/s
constexpr double kWait = 0.3;        // s for the first cloud
constexpr double kKeeps = 1.5;       // s that it keeps to a side
constexpr double kTurns[] = {0.26, 0.52, 0.79};  // rad from its way: 15° to 45°

double Most(const Vector2d& along) {
  return (along.x() > 0 ? kAhead : kBehind) * std::abs(along.x()) + kAside * std::abs(along.y());
}

// How fast [m/s] it goes where so much of its way is free [m].
double Slowed(double free) { return std::max(0.0, (free - kStop) / kTime); }

}  // namespace

double FreeWay(const Vector2d& along, const robot::SeenObstacles& seen) {
  const Vector2d aside(-along.y(), along.x());
  const double front = Most(along), left = Most(aside), right = Most(-aside);
  double free = kFarthest;
  for (const Vector2d& point : seen.all()) {
    const double ahead = along.dot(point), off = aside.dot(point);
    // What is beside the body is not met by going on.
    const double margin = ahead > front ? kMargin : 0;
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
    return waited_ > kWait ? wish : Vector3d(0, 0, wish.z());
  }
  straight_ += dt;
  if (straight_ > kKeeps) side_ = 0;
  if (speed == 0) return wish;
  const Vector2d along = wish.head<2>() / speed;
  const double free = FreeWay(along, seen);
  if (free >= kFarthest || Slowed(free) >= speed) return wish;
  Vector2d way = along * std::min(speed, Slowed(free));
  if (const auto round = RoundFrom(along, free, seen)) {
    side_ = round->side;
    straight_ = 0;
    way = std::min({speed, kRoundSpeed, Slowed(round->free)}) * round->along;
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
    for (const double turn : kTurns) {
      const Vector2d way = Eigen::Rotation2Dd(side * turn) * along;
      const double around = FreeWay(way, seen);
      if (around * std::cos(turn) < free + kPast) continue;
      if (side == side_) return Round{side, turn, around, way};
      if (!best || turn < best->turn) best = Round{side, turn, around, way};
      break;
    }
  }
  return best;
}

}  // namespace understudy::motion
