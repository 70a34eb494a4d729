#include "perception/clearance.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace understudy::perception {
namespace {

using Eigen::Vector3d;

constexpr double kBand = 0.2;     // m, half the width of a band
constexpr double kGround = 0.08;  // m over the ground, below which it is ground; *assumed*, as all
constexpr double kRoof = 0.3;     // m over the base, above which the robot passes
constexpr double kDepth = 0.05;   // m behind the nearest echo that count for its distance
const Vector3d kBody(0.45, 0.3, 0.5);  // m, half the sides of the box that the robot fills

struct Seen {
  std::size_t side;
  double distance;
};

std::optional<Seen> SeenAt(const Vector3d& p, double height) {
  if (p.z() < kGround - height || p.z() > kRoof) return std::nullopt;
  if (IsOfRobot(p, height)) return std::nullopt;
  if (std::abs(p.y()) < kBand && p.x() > 0) return Seen{0, p.x()};
  if (std::abs(p.x()) < kBand)
    return Seen{p.y() > 0 ? std::size_t{1} : std::size_t{2}, std::abs(p.y())};
  return std::nullopt;
}

}  // namespace

bool IsOfRobot(const Vector3d& p, double height) {
  return (p.cwiseAbs().array() < kBody.array()).all() && p.z() > kGround - height;
}

void Clearance::Begin() { sides_.fill({}); }

void Clearance::Near(const Vector3d& p, double height) {
  if (const auto seen = SeenAt(p, height)) {
    double& nearest = sides_[seen->side].nearest;
    nearest = std::min(nearest, seen->distance);
  }
}

void Clearance::Average(const Vector3d& p, double height) {
  const auto seen = SeenAt(p, height);
  if (!seen) return;
  Side& side = sides_[seen->side];
  if (seen->distance > side.nearest + kDepth) return;
  side.sum += seen->distance;
  ++side.count;
}

void Clearance::End() {
  Vector3d& cloud = last_[clouds_++ % kClouds];
  for (int i = 0; i < 3; ++i) {
    const Side& side = sides_[static_cast<std::size_t>(i)];
    cloud[i] = side.count > 0 ? std::min(side.sum / side.count, kFarthest) : kFarthest;
  }
}

Vector3d Clearance::Read() const {
  Vector3d clear = Vector3d::Constant(kFarthest);
  for (std::size_t i = 0; i < std::min(clouds_, kClouds); ++i) clear = clear.cwiseMin(last_[i]);
  return clear;
}

}  // namespace understudy::perception
