#include "motion/humanoid/stand_balance.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {
namespace {

// All assumed, tuned on every robot here with pushes, joint friction and sensor noise.
constexpr double kCaptureGain = 2.5;  // k: how far the pressure runs ahead of the capture point
constexpr double kHeightRate = 10;    // rad/s of the spring that keeps the height
constexpr double kTiltRate = 10;      // rad/s of the spring that keeps the base upright
constexpr double kTurnRate = 5;       // rad/s, about the vertical
constexpr double kDampingRatio = 0.7;
constexpr double kGyration = 0.3;       // radius of gyration of the body, of the height of its
                                        // centre of mass
constexpr double kBalanceMargin = 0.9;  // share of the soles that balance may lean on
constexpr double kSoleMargin = 0.95;    // share of a sole that may be pressed on at all
constexpr double kSmoothTime = 0.008;   // s, over which rates are smoothed
constexpr double kMostLift = 0.4;       // of the weight, more or less
constexpr double kMostPush = 0.3;  // of horizontal to vertical force; soles slip at 0.4 or more

// The soles seen from above, in axes along and across the line from one to the other.
struct Support {
  explicit Support(std::span<const Sole> soles) {
    const Eigen::Vector2d apart = (soles[1].p_OS - soles[0].p_OS).head<2>();
    distance = std::max(apart.norm(), 1e-3);
    across = apart / distance;
    along = {-across.y(), across.x()};
    // Forwards is the direction of the toes, for either order of the feet.
    const Eigen::Vector2d toes = (soles[0].forward + soles[1].forward).head<2>();
    if (along.dot(toes) < 0) along = -along;
    left = {-along.y(), along.x()};
    half_length = std::min(soles[0].half_length, soles[1].half_length);
    half_width = std::min(soles[0].half_width, soles[1].half_width);
  }

  // Returns the nearest point to p [m] within the soles scaled by `share`.
  Eigen::Vector2d Nearest(const Eigen::Vector2d& p, double share) const {
    const double x = share * half_length, y = distance / 2 + share * half_width;
    return along * std::clamp(along.dot(p), -x, x) + across * std::clamp(across.dot(p), -y, y);
  }

  double distance;
  Eigen::Vector2d along, across, left;  // of length 1; along is forwards
  double half_length, half_width;
};

Eigen::Vector3d Above(const Eigen::Vector2d& p, double z) { return {p.x(), p.y(), z}; }

}  // namespace

Eigen::Vector2d ComOffset(const BodyModel& body) {
  const Support support(body.soles());
  const Eigen::Vector2d c = body.com().head<2>();
  return {support.along.dot(c), support.left.dot(c)};
}

void StandBalance::Step(const BodyModel& body, const StandGoal& goal, double load, double dt) {
  const Support support(body.soles());
  const Eigen::Vector3d& c = body.com();
  const Eigen::Vector2d v = body.com_velocity().head<2>();
  // Smoothed rates.
  const double share = fresh_ ? 1 : dt / (dt + kSmoothTime);
  velocity_ += share * (v - velocity_);
  rate_ += share * (body.base_rate() - rate_);
  fresh_ = false;

  // Inverted pendulum: the centre of pressure.
  const double height = std::max(c.z(), 0.1);
  const double omega = std::sqrt(body.gravity() / height);
  const Eigen::Vector2d c_goal =
      support.along * goal.com_offset.x() + support.left * goal.com_offset.y();
  const Eigen::Vector2d capture = c.head<2>() + velocity_ / omega;
  const Eigen::Vector2d p =
      support.Nearest(c_goal + kCaptureGain * (capture - c_goal), kBalanceMargin);

  // Force: height spring, and the push of the pendulum.
  const double weight = load * body.mass() * body.gravity();
  const double lift = load * body.mass() *
                      (kHeightRate * kHeightRate * (goal.base_height - body.base().z()) -
                       2 * kHeightRate * body.base_velocity().z());
  const double up = weight + std::clamp(lift, -kMostLift * weight, kMostLift * weight);
  Eigen::Vector2d push = load * body.mass() * omega * omega * (c.head<2>() - p);
  if (push.norm() > kMostPush * up) push *= kMostPush * up / push.norm();
  const Eigen::Vector3d force = Above(push, up);

  // Attitude: the goal has the heading of the soles.
  const double yaw = std::atan2(support.along.y(), support.along.x());
  const Eigen::Quaterniond wanted = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                    Eigen::AngleAxisd(goal.pitch, Eigen::Vector3d::UnitY());
  const Eigen::AngleAxisd error(wanted.toRotationMatrix() * body.attitude().transpose());
  const double gyration = kGyration * height;
  const double inertia = load * body.mass() * gyration * gyration;
  const Eigen::Vector3d spring(kTiltRate, kTiltRate, kTurnRate);
  const Eigen::Vector3d moment =
      inertia * (spring.cwiseProduct(spring).cwiseProduct(error.angle() * error.axis()) -
                 2 * kDampingRatio * spring.cwiseProduct(rate_));

  // The centre of pressure for that force and that moment about the centre of mass.
  const Eigen::Vector3d about_O = moment + c.cross(force);
  const double least = std::max(up, 1.0);
  Share(body, Eigen::Vector2d(-about_O.y(), about_O.x()) / least, force, moment.z());
}

void StandBalance::CarryWeight(const BodyModel& body, double load) {
  fresh_ = true;
  Share(body, body.com().head<2>(), {0, 0, load * body.mass() * body.gravity()}, 0);
}

void StandBalance::Share(const BodyModel& body, Eigen::Vector2d p, const Eigen::Vector3d& force,
                         double turn) {
  const std::span<const Sole> soles = body.soles();
  const Support support(soles);
  p = support.Nearest(p, kSoleMargin);
  const double second = std::clamp(0.5 + support.across.dot(p) / support.distance, 0.0, 1.0);
  const double aside = support.across.dot(p) - (second - 0.5) * support.distance;
  const Eigen::Vector2d arm = support.along * support.along.dot(p) + support.across * aside;
  for (std::size_t i = 0; i < reactions_.size(); ++i) {
    const double share = i == 1 ? second : 1 - second;
    reactions_[i].force = share * force;
    reactions_[i].moment =
        Above(arm, 0).cross(reactions_[i].force) + Eigen::Vector3d(0, 0, share * turn);
  }
}

}  // namespace understudy::motion
