#include "mjcf/urdf_inertial.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "base/printed.h"
#include "mjcf/joints.h"
#include "mjcf/urdf_elements.h"

namespace understudy::mjcf {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLeastMass = 0.001;     // kg, of what moves and has none
constexpr double kLeastInertia = 1e-6;   // kg·m²
constexpr double kWater = 1000;          // kg/m³, assumed: robots float about as much as they sink
constexpr double kSlimmest = 1e-3;       // the smallest moment against the largest, assumed: a rod
constexpr double kLeastMoment = 1e-14;   // kg·m², mjEPS of MuJoCo, which takes no smaller ones
constexpr double kTiny = 1e-12;          // kg·m², of a link that is a mere place; assumed
constexpr double kNoSmaller = 1 + 1e-9;  // so that rounding undercuts nothing

double MomentOfBall(double mass) {
  const double radius = std::cbrt(3 * mass / (4 * std::numbers::pi * kWater));
  return 0.4 * mass * radius * radius;
}

// Ascending.
Vector3d Moments(const Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia, Eigen::EigenvaluesOnly).eigenvalues();
}

std::string Text(const Vector3d& moments) {
  return Printed("%.3g %.3g %.3g", moments.x(), moments.y(), moments.z());
}

}  // namespace

std::optional<Matrix3d> RepairedInertia(const Matrix3d& given, double mass) {
  const Eigen::SelfAdjointEigenSolver<Matrix3d> solver(given);
  Vector3d moments = solver.eigenvalues();                   // ascending
  const double over = moments[2] - moments[0] - moments[1];  // of a flat plate 0, but for rounding
  if (moments[0] > kLeastMoment && over <= kLeastMoment / 2) return std::nullopt;
  if (moments[2] <= kLeastMoment) {
    return Matrix3d(Matrix3d::Identity() * std::max(MomentOfBall(mass), kTiny));
  }
  const double least = std::max(kSlimmest * moments[2], kTiny);
  moments = moments.cwiseMax(least);
  const double lacking = moments[2] * kNoSmaller - moments[0] - moments[1];
  if (lacking > 0) moments.head<2>().array() += lacking / 2;
  return Matrix3d(solver.eigenvectors() * moments.asDiagonal() * solver.eigenvectors().transpose());
}

std::optional<MjcfElement> InertialOf(const MjcfElement& link, bool moves,
                                      std::vector<std::string>* notes) {
  const MjcfElement* inertial = ChildOf(link, "inertial");
  const double mass = inertial == nullptr ? 0 : NumberIn(ChildOf(*inertial, "mass"), "value", 0);
  if (mass < 0) FailAt(*inertial, "a mass below 0");
  const std::string name = "link '" + link.Get("name") + "'";
  MjcfElement made{"inertial", {}, {}, link.place};
  if (mass > 0) {
    const UrdfOrigin origin = OriginOf(*inertial);
    const MjcfElement* given = ChildOf(*inertial, "inertia");
    const auto n = [&](const char* part) { return NumberIn(given, part, 0); };
    const double xx = n("ixx"), xy = n("ixy"), xz = n("ixz"), yy = n("iyy"), yz = n("iyz"),
                 zz = n("izz");
    Matrix3d about_own;
    about_own << xx, xy, xz, xy, yy, yz, xz, yz, zz;
    if (const std::optional<Matrix3d> repaired = RepairedInertia(about_own, mass)) {
      notes->push_back(name + ": no body has its principal moments of inertia, " +
                       Text(Moments(about_own)) + " kg m2; it gets " + Text(Moments(*repaired)));
      about_own = *repaired;
    }
    const Matrix3d r = origin.r.toRotationMatrix();
    const Matrix3d i = r * about_own * r.transpose();
    const std::array<double, 6> full{i(0, 0), i(1, 1), i(2, 2), i(0, 1), i(0, 2), i(1, 2)};
    made.Set("pos", TextOf(origin.p));
    made.Set("mass", TextOf(mass));
    made.Set("fullinertia", NumbersText(full));
  } else if (moves) {
    notes->push_back(name + " moves and has no mass: it gets " + TextOf(kLeastMass) + " kg");
    made.Set("pos", "0 0 0");
    made.Set("mass", TextOf(kLeastMass));
    made.Set("diaginertia", TextOf(Vector3d::Constant(kLeastInertia)));
  } else {
    return std::nullopt;
  }
  return made;
}

}  // namespace understudy::mjcf
