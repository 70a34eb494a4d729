#include "motion/quadruped/goal_facts.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <variant>

namespace understudy::motion {
namespace {

namespace goal = authority::goal;

constexpr double kMostShift = 0.2;  // of the leg's length, of the body over its feet; assumed

bool AreFinite(std::initializer_list<double> numbers) {
  return std::ranges::all_of(numbers, [](double x) { return std::isfinite(x); });
}

struct Soundness {
  bool operator()(const goal::Euler& g) const { return AreFinite({g.roll, g.pitch, g.yaw}); }
  bool operator()(const goal::Move& g) const { return AreFinite({g.vx, g.vy, g.yaw_rate}); }
  bool operator()(const goal::BodyHeight& g) const { return std::isfinite(g.height); }
  bool operator()(const goal::FootRaise& g) const { return std::isfinite(g.over); }
  bool operator()(const goal::BodyPosition& g) const { return AreFinite({g.x, g.y, g.z, g.yaw}); }
  bool operator()(const goal::GoTo& g) const { return AreFinite({g.x, g.y, g.yaw}); }
  bool operator()(const goal::Gait& g) const { return g.name != goal::GaitName::kNone; }
  bool operator()(const goal::FollowPath& g) const {
    double last = 0;
    const auto sound = [&](const goal::PathPoint& p) {
      return AreFinite({p.t, p.x, p.y, p.yaw}) && p.t >= std::exchange(last, p.t);
    };
    return g.points != nullptr && std::ranges::all_of(*g.points, sound);
  }
  bool operator()(const auto&) const { return true; }
};

}  // namespace

bool IsSound(const authority::MotionGoal& goal) { return std::visit(Soundness{}, goal); }

bool IsGesture(const authority::MotionGoal& goal) {
  return std::holds_alternative<goal::Gesture>(goal) || std::holds_alternative<goal::Sit>(goal) ||
         std::holds_alternative<goal::Pose>(goal);
}

bool IsMove(const authority::MotionGoal& goal) {
  return std::holds_alternative<goal::Move>(goal) || std::holds_alternative<goal::GoTo>(goal) ||
         std::holds_alternative<goal::FollowPath>(goal);
}

std::optional<StancePose> PoseOf(const authority::MotionGoal& goal, const StancePose& wanted,
                                 const robot::QuadrupedMotionSpec& figures, double leg_length) {
  StancePose pose = wanted;
  const auto height = [&](double over) {
    return figures.stand_height +
           std::clamp(over, figures.height_range[0], figures.height_range[1]);
  };
  if (const auto* euler = std::get_if<goal::Euler>(&goal)) {
    const auto& most = figures.euler_range;
    pose.rpy = {std::clamp(euler->roll, -most[0], most[0]),
                std::clamp(euler->pitch, -most[1], most[1]),
                std::clamp(euler->yaw, -most[2], most[2])};
  } else if (const auto* body = std::get_if<goal::BodyHeight>(&goal)) {
    pose.place.z() = height(body->height);
  } else if (const auto* shift = std::get_if<goal::BodyPosition>(&goal)) {
    const double most = kMostShift * leg_length;
    pose.place = {std::clamp(shift->x, -most, most), std::clamp(shift->y, -most, most),
                  height(shift->z)};
    pose.rpy.z() = std::clamp(shift->yaw, -figures.euler_range[2], figures.euler_range[2]);
  } else {
    return std::nullopt;
  }
  return pose;
}

}  // namespace understudy::motion
