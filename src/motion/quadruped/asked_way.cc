#include "motion/quadruped/asked_way.h"

#include <limits>
#include <variant>

#include <Eigen/Geometry>

namespace understudy::motion {

using Eigen::Vector3d;
namespace goal = authority::goal;

bool AskedWay::Take(const authority::MotionGoal& goal, double sticks, const Vector3d& here) {
  if (const auto* move = std::get_if<goal::Move>(&goal)) {
    path_.End();
    avoids_ = move->avoids;
    velocity_ = (move->by_sticks ? sticks : 1) * Vector3d(move->vx, move->vy, move->yaw_rate);
    counts_for_ =
        lasting_ && !move->by_sticks ? std::numeric_limits<double>::infinity() : move->hold;
  } else if (const auto* path = std::get_if<goal::FollowPath>(&goal)) {
    End();
    path_.Begin(*path->points, here);
  } else if (const auto* place = std::get_if<goal::GoTo>(&goal)) {
    End();
    const Eigen::AngleAxisd turned(place->from_here ? here.z() : 0, Vector3d::UnitZ());
    const Vector3d way = turned * Vector3d(place->x, place->y, place->yaw);
    avoids_ = place->avoids;
    path_.GoTo(place->from_here ? Vector3d(here + way) : way, here);
  } else {
    return false;
  }
  return true;
}

void AskedWay::End() {
  path_.End();
  velocity_.setZero();
  counts_for_ = 0;
  avoids_ = false;
}

Vector3d AskedWay::Step(double dt, const Vector3d& here, const robot::SeenObstacles* obstacles) {
  Vector3d asked = Asked(dt, here);
  avoided_ = avoids_ && !asked.isZero(0) ? 0 : avoided_ + dt;
  if (!avoids()) avoidance_.Rest();
  if (avoided_ > 0 || obstacles == nullptr) return asked;
  return avoidance_.Limit(asked, *obstacles, dt);
}

Vector3d AskedWay::Asked(double dt, const Vector3d& here) {
  if (!path_.over()) return path_.Step(dt, here);
  counts_for_ -= dt;
  if (counts_for_ <= 0) velocity_.setZero();
  return velocity_;
}

}  // namespace understudy::motion
