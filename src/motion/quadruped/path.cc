#include "motion/quadruped/path.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>

namespace understudy::motion {
namespace {

using authority::goal::PathPoint;
using Eigen::Vector3d;

// All assumed.
constexpr double kWaySpeed = 0.5, kWayTurnRate = 0.8;  // m/s, rad/s, of a way that has no times
constexpr double kWayCatchUp = 1.5;                    // 1/s
constexpr double kWayThere = 0.08;                     // m and rad
constexpr double kWayRest = 0.5;                       // s that it must stay there
constexpr double kWayPatience = 3;                     // s after the last point's time

double Wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

// `to` - `from`, the turn the short way.
Vector3d Way(const Vector3d& from, const Vector3d& to) {
  const Vector3d way = to - from;
  return {way.x(), way.y(), Wrapped(way.z())};
}

Vector3d PlaceOf(const PathPoint& point) { return {point.x, point.y, point.yaw}; }

}  // namespace

void PathFollower::Begin(std::span<const PathPoint> points, const Vector3d& here) {
  points_.clear();
  t_ = there_ = 0;
  if (points.empty()) return;
  points_.push_back({0, here.x(), here.y(), here.z()});
  points_.insert(points_.end(), points.begin(), points.end());
}

void PathFollower::GoTo(const Vector3d& place, const Vector3d& here) {
  const Vector3d way = Way(here, place);
  const double time = std::max(way.head<2>().norm() / kWaySpeed, std::abs(way.z()) / kWayTurnRate);
  const PathPoint end{time, place.x(), place.y(), place.z()};
  Begin({&end, 1}, here);
}

Vector3d PathFollower::Step(double dt, const Vector3d& here) {
  if (over()) return Vector3d::Zero();
  t_ += dt;
  const auto next = std::ranges::find_if(points_, [&](const PathPoint& p) { return p.t > t_; });
  Vector3d wanted = PlaceOf(points_.back()), rate(0, 0, 0);
  if (next != points_.end()) {
    const PathPoint& last = *std::prev(next);
    const Vector3d way = Way(PlaceOf(last), PlaceOf(*next));
    rate = way / (next->t - last.t);
    wanted = PlaceOf(last) + (t_ - last.t) * rate;
  } else {
    there_ = Way(here, wanted).isZero(kWayThere) ? there_ + dt : 0;
    if (there_ > kWayRest || t_ > points_.back().t + kWayPatience) {
      End();
      return Vector3d::Zero();
    }
  }
  const Vector3d v = rate + kWayCatchUp * Way(here, wanted);
  const double c = std::cos(here.z()), s = std::sin(here.z());
  return {c * v.x() + s * v.y(), c * v.y() - s * v.x(), v.z()};
}

}  // namespace understudy::motion
