#include "motion/humanoid/foot_swing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "motion/joint_move.h"

namespace understudy::motion {
namespace {

// All assumed, tried on every robot here.
constexpr double kEarly = 0.02;        // s before landing at which the foot is over its place
constexpr double kLeastWay = 0.03;     // s in which it may at most be hurried there
constexpr double kHighest = 0.4;       // of the swing, when it is lifted most
constexpr double kPress = 0.005;       // m, under the ground, where the swing ends
constexpr double kLandingSpeed = 0.1;  // m/s, downwards

// Position, velocity and acceleration along one axis.
struct Axis {
  double p = 0, v = 0, a = 0;
};

// After t s of the polynomial of fifth order from one to the other in `time` s.
Axis Between(const Axis& from, const Axis& to, double time, double t) {
  const double s = t / time;
  const double v0 = from.v * time, v1 = to.v * time;
  const double a0 = from.a * time * time / 2, a1 = to.a * time * time / 2;
  const double way = to.p - from.p - v0 - a0, speed = v1 - v0 - 2 * a0, pull = a1 - a0;
  const double c3 = 10 * way - 4 * speed + pull;
  const double c4 = -15 * way + 7 * speed - 2 * pull;
  const double c5 = 6 * way - 3 * speed + pull;
  return {.p = from.p + s * (v0 + s * (a0 + s * (c3 + s * (c4 + s * c5)))),
          .v = (v0 + s * (2 * a0 + s * (3 * c3 + s * (4 * c4 + s * 5 * c5)))) / time,
          .a = (2 * a0 + s * (6 * c3 + s * (12 * c4 + s * 20 * c5))) / (time * time)};
}

}  // namespace

void FootSwing::Begin(const Eigen::Vector3d& p, double yaw) {
  p_ = p;
  v_.setZero();
  a_.setZero();
  from_z_ = p.z();
  from_yaw_ = yaw_ = yaw;
}

void FootSwing::Step(double elapsed, double time, const Eigen::Vector3d& landing, double yaw,
                     double raise, double dt) {
  const double left = time - kEarly - elapsed;
  for (int i = 0; i < 2; ++i) {
    Axis axis{.p = p_[i]};
    if (left > dt) {
      axis = Between({.p = p_[i], .v = v_[i], .a = a_[i]}, {.p = landing[i]},
                     std::max(left, kLeastWay), dt);
    }
    p_[i] = axis.p;
    v_[i] = axis.v;
    a_[i] = axis.a;
  }
  const double highest = kHighest * time;
  const Axis top{.p = from_z_ + raise}, down{.p = landing.z() - kPress, .v = -kLandingSpeed};
  const Axis z = elapsed < highest
                     ? Between({.p = from_z_}, top, highest, elapsed)
                     : Between(top, down, time - highest, std::min(elapsed, time) - highest);
  p_.z() = z.p;
  v_.z() = z.v;
  a_.z() = z.a;
  yaw_ = from_yaw_ +
         std::remainder(yaw - from_yaw_, 2 * std::numbers::pi) * SmoothStep(elapsed / time);
}

}  // namespace understudy::motion
