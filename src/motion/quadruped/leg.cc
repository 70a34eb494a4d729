#include "motion/quadruped/leg.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace understudy::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kReached = 1e-6;  // m, of rounding

// The angle of the same direction that lies in the range, or nearest to it.
double IntoRange(double angle, double low, double high) {
  constexpr double kTurn = 2 * std::numbers::pi;
  const double middle = std::isfinite(low + high) ? (low + high) / 2 : 0;
  const double off = angle - middle;
  // Most lie in it already, and the remainder takes longer than the rest of a leg's angles.
  return (std::abs(off) <= kTurn / 2 ? off : std::remainder(off, kTurn)) + middle;
}

// R times a turn by `angle` about y.
Matrix3d Swung(const Matrix3d& R, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  Matrix3d swung;
  swung.col(0) = c * R.col(0) - s * R.col(2);
  swung.col(1) = R.col(1);
  swung.col(2) = s * R.col(0) + c * R.col(2);
  return swung;
}

}  // namespace

QuadrupedLeg::QuadrupedLeg(const LegFigures& figures)
    : figures_(figures),
      side_(figures.thigh.y() + figures.calf.y() + figures.foot.y()),
      thigh_length_(std::hypot(figures.calf.x(), figures.calf.z())),
      thigh_angle_(std::atan2(-figures.calf.x(), -figures.calf.z())),
      calf_length_(std::hypot(figures.foot.x(), figures.foot.z())),
      calf_angle_(std::atan2(-figures.foot.x(), -figures.foot.z())) {}

LegPlaces QuadrupedLeg::Place(const Vector3d& q) const {
  LegPlaces places;
  const double c = std::cos(q[0]), s = std::sin(q[0]);
  places.R_hip << 1, 0, 0, 0, c, -s, 0, s, c;
  // Thigh and calf turn about the same axis, the hip's y.
  places.R_thigh = Swung(places.R_hip, q[1]);
  places.R_calf = Swung(places.R_hip, q[1] + q[2]);
  places.hip = figures_.hip;
  places.thigh = places.hip + places.R_hip * figures_.thigh;
  places.calf = places.thigh + places.R_thigh * figures_.calf;
  places.foot = places.calf + places.R_calf * figures_.foot;
  return places;
}

Matrix3d CalfJacobian(const LegPlaces& places, const Vector3d& point) {
  const Vector3d swing = places.R_hip.col(1);  // the axis of thigh and calf
  Matrix3d jacobian;
  jacobian.col(0) = Vector3d::UnitX().cross(point - places.hip);
  jacobian.col(1) = swing.cross(point - places.thigh);
  jacobian.col(2) = swing.cross(point - places.calf);
  return jacobian;
}

Matrix3d FootJacobian(const LegPlaces& places) { return CalfJacobian(places, places.foot); }

Vector3d QuadrupedLeg::MassMoment(const LegPlaces& places) const {
  const auto& links = figures_.links;
  return links[0].mass * (places.hip + places.R_hip * links[0].com) +
         links[1].mass * (places.thigh + places.R_thigh * links[1].com) +
         links[2].mass * (places.calf + places.R_calf * links[2].com);
}

Matrix3d QuadrupedLeg::MassMatrix(const LegPlaces& places) const {
  const std::array<const Vector3d*, 3> origins{&places.hip, &places.thigh, &places.calf};
  const std::array<const Matrix3d*, 3> turns{&places.R_hip, &places.R_thigh, &places.R_calf};
  const Vector3d swing = places.R_hip.col(1);
  Matrix3d mass = figures_.armature.asDiagonal();
  for (int link = 0; link < 3; ++link) {
    const auto at = static_cast<std::size_t>(link);
    const LinkMass& lump = figures_.links[at];
    const Vector3d com = *origins[at] + *turns[at] * lump.com;
    Matrix3d linear = Matrix3d::Zero(), angular = Matrix3d::Zero();
    for (int joint = 0; joint <= link; ++joint) {
      const Vector3d axis = joint == 0 ? Vector3d::UnitX() : swing;
      angular.col(joint) = axis;
      linear.col(joint) = axis.cross(com - *origins[static_cast<std::size_t>(joint)]);
    }
    const Matrix3d inertia = *turns[at] * lump.inertia * turns[at]->transpose();
    mass += lump.mass * linear.transpose() * linear + angular.transpose() * inertia * angular;
  }
  return mass;
}

Matrix3d QuadrupedLeg::InertiaAbout(const LegPlaces& places, const Vector3d& p) const {
  const auto of = [&](std::size_t link, const Vector3d& origin, const Matrix3d& R) -> Matrix3d {
    const LinkMass& lump = figures_.links[link];
    return R * lump.inertia * R.transpose() + PointInertia(lump.mass, origin + R * lump.com - p);
  };
  return of(0, places.hip, places.R_hip) + of(1, places.thigh, places.R_thigh) +
         of(2, places.calf, places.R_calf);
}

Vector3d QuadrupedLeg::FrictionTorque(const Vector3d& dq) const {
  constexpr double kCreep = 0.3;  // rad/s within which it changes its sign, assumed
  const Vector3d part = (dq / kCreep).array().tanh();
  return figures_.damping.cwiseProduct(dq) + figures_.friction.cwiseProduct(part);
}

Vector3d QuadrupedLeg::HoldingTorque(const LegPlaces& places, const Vector3d& up,
                                     double gravity) const {
  const auto& links = figures_.links;
  // What hangs on each joint: mass and mass times place.
  const Vector3d on_calf = links[2].mass * (places.calf + places.R_calf * links[2].com);
  const Vector3d on_thigh =
      on_calf + links[1].mass * (places.thigh + places.R_thigh * links[1].com);
  const Vector3d on_hip = on_thigh + links[0].mass * (places.hip + places.R_hip * links[0].com);
  const double calf_mass = links[2].mass;
  const double thigh_mass = calf_mass + links[1].mass;
  const double hip_mass = thigh_mass + links[0].mass;
  const Vector3d swing = places.R_hip.col(1);
  const Vector3d lift = gravity * up;
  return {Vector3d::UnitX().cross(on_hip - hip_mass * places.hip).dot(lift),
          swing.cross(on_thigh - thigh_mass * places.thigh).dot(lift),
          swing.cross(on_calf - calf_mass * places.calf).dot(lift)};
}

Vector3d QuadrupedLeg::Sole(const LegPlaces& places, const Vector3d& up) const {
  if (figures_.half_width == 0) return -figures_.radius * up;
  constexpr double kFlat = 0.03;  // rad within which both edges of a tyre carry load; assumed
  const Vector3d axis = places.R_hip.col(1);
  const double lean = axis.dot(up);
  const Vector3d down = (lean * axis - up).normalized();
  return figures_.radius * down - figures_.half_width * std::clamp(lean / kFlat, -1.0, 1.0) * axis;
}

Vector3d QuadrupedLeg::Angles(const Vector3d& foot) const {
  const Vector3d p = foot - figures_.hip;
  // Seen from the front: the foot is `side_` beside the hip's axis and `down` below it.
  const double down = std::sqrt(std::max(p.y() * p.y() + p.z() * p.z() - side_ * side_, 0.0));
  const double hip = std::atan2(p.z(), p.y()) - std::atan2(-down, side_);
  // Seen from the side: a triangle of thigh, calf and the line to the foot.
  const double x = p.x() - figures_.thigh.x();
  const double z = -down - figures_.thigh.z();
  const double cosine =
      (x * x + z * z - thigh_length_ * thigh_length_ - calf_length_ * calf_length_) /
      (2 * thigh_length_ * calf_length_);
  const double knee = -std::acos(std::clamp(cosine, -1.0, 1.0));
  const double thigh =
      std::atan2(-x, -z) -
      std::atan2(calf_length_ * std::sin(knee), thigh_length_ + calf_length_ * std::cos(knee)) -
      thigh_angle_;
  const Vector3d exact(hip, thigh, knee - calf_angle_ + thigh_angle_);
  Vector3d angles;
  for (int i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i);
    const double low = figures_.low[at], high = figures_.high[at];
    angles[i] = std::clamp(IntoRange(exact[i], low, high), low, high);
  }
  return angles;
}

bool QuadrupedLeg::Reach(const Vector3d& foot, Vector3d* q) const {
  *q = Angles(foot);
  return (Place(*q).foot - foot).norm() < kReached;
}

double QuadrupedLeg::mass() const {
  return figures_.links[0].mass + figures_.links[1].mass + figures_.links[2].mass;
}

}  // namespace understudy::motion
