#include "perception/obstacle_map.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace understudy::perception {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// All *assumed*.
constexpr double kMapCell = 0.08;         // m
constexpr std::int64_t kRemembered = 30;  // clouds: two seconds of an L1's
constexpr std::int64_t kWindow = 15;      // clouds
constexpr double kStepsUp = 0.12;         // m that it steps up
constexpr double kGroundRise = 0.03;  // by which the ground seems to rise, by errors of attitude
constexpr double kOwnX = 0.45, kOwnY = 0.3;  // m, half the sides of what its legs may be in
constexpr double kPassesUnder = 0.2;         // m over the base, above which it passes
constexpr std::int64_t kGroundAround = 2;    // cells on each side that have the ground

std::int64_t MapCellOf(double at) { return static_cast<std::int64_t>(std::floor(at / kMapCell)); }

Vector2d MapMiddleOf(std::int64_t x, std::int64_t y) {
  return kMapCell * Vector2d(static_cast<double>(x) + 0.5, static_cast<double>(y) + 0.5);
}

}  // namespace

ObstacleMap::ObstacleMap() : cells_(static_cast<std::size_t>(kCells * kCells)) {}

void ObstacleMap::Clear() {
  cloud_ = 0;
  std::ranges::fill(cells_, Cell{});
}

std::size_t ObstacleMap::PlaceOf(std::int64_t x, std::int64_t y) {
  const auto wrapped = [](std::int64_t at) { return (at % kCells + kCells) % kCells; };
  return static_cast<std::size_t>(wrapped(y) * kCells + wrapped(x));
}

void ObstacleMap::Begin(const robot::LegOdometry& base, double altitude) {
  ++cloud_;
  base_ = base;
  altitude_ = altitude;
}

void ObstacleMap::Add(const Vector3d& p_OP, const Vector3d& p_BP) {
  if ((p_OP - base_.p_OB).head<2>().squaredNorm() > kFarthest * kFarthest) return;
  const double above = p_OP.z() - base_.p_OB.z();  // the base
  const bool own = std::abs(p_BP.x()) < kOwnX && std::abs(p_BP.y()) < kOwnY;
  if (above > kPassesUnder || own) return;
  const std::int64_t x = MapCellOf(p_OP.x()), y = MapCellOf(p_OP.y());
  Cell& cell = cells_[PlaceOf(x, y)];
  const std::int64_t window = cloud_ / kWindow;
  const auto z = static_cast<float>(altitude_ + above);
  if (!IsFresh(cell) || cell.x != x || cell.y != y) {
    cell = {.x = x, .y = y, .cloud = cloud_, .low = z, .high = z, .before = z, .window = window};
    return;
  }
  cell.cloud = cloud_;
  cell.low = std::min(cell.low, z);
  if (cell.window != window) {
    cell.before = cell.window + 1 == window ? cell.high : z;
    cell.high = z;
    cell.window = window;
  }
  cell.high = std::max(cell.high, z);
}

bool ObstacleMap::IsFresh(const Cell& cell) const { return cell.cloud > cloud_ - kRemembered; }

bool ObstacleMap::Blocks(const Cell& cell) const {
  float ground = cell.low;
  for (std::int64_t y = cell.y - kGroundAround; y <= cell.y + kGroundAround; ++y) {
    for (std::int64_t x = cell.x - kGroundAround; x <= cell.x + kGroundAround; ++x) {
      const Cell& near = cells_[PlaceOf(x, y)];
      if (near.x == x && near.y == y && IsFresh(near)) ground = std::min(ground, near.low);
    }
  }
  const double away = (MapMiddleOf(cell.x, cell.y) - base_.p_OB.head<2>()).norm();
  return std::max(cell.high, cell.before) - ground > kStepsUp + kGroundRise * away;
}

void ObstacleMap::Read(robot::SeenObstacles* seen) const {
  constexpr double kSectors = robot::SeenObstacles::kSectors;
  constexpr double kNone = std::numeric_limits<double>::infinity();
  const Vector3d ahead = base_.R_OB * Vector3d::UnitX();
  const double yaw = std::atan2(ahead.y(), ahead.x());
  const double c = std::cos(yaw), s = std::sin(yaw);
  std::array<Vector2d, robot::SeenObstacles::kSectors> nearest;
  nearest.fill({kNone, kNone});
  for (const Cell& cell : cells_) {
    if (!IsFresh(cell) || !Blocks(cell)) continue;
    const Vector2d way = MapMiddleOf(cell.x, cell.y) - base_.p_OB.head<2>();
    if (way.norm() > kFarthest) continue;
    const Vector2d at(c * way.x() + s * way.y(), c * way.y() - s * way.x());
    const double turn = std::atan2(at.y(), at.x()) / (2 * std::numbers::pi) + 0.5;
    const auto sector = std::min(static_cast<std::size_t>(turn * kSectors), nearest.size() - 1);
    if (at.squaredNorm() < nearest[sector].squaredNorm()) nearest[sector] = at;
  }
  seen->known = cloud_ > 0;
  seen->count = 0;
  for (const Vector2d& at : nearest) {
    if (std::isfinite(at.x())) seen->points[seen->count++] = at;
  }
}

}  // namespace understudy::perception
