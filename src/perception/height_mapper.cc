#include "perception/height_mapper.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace understudy::perception {
namespace {

constexpr float kUnseen = robot::HeightMap::kUnseen;
constexpr double kLevel = 0.05;  // m, *assumed*, as the next
constexpr double kShare = 0.2;

std::int64_t CellOf(double at) {
  return static_cast<std::int64_t>(std::floor(at / robot::HeightMap::kCell));
}

}  // namespace

HeightMapper::HeightMapper() : heights_(static_cast<std::size_t>(kCells) * kCells, kUnseen) {}

void HeightMapper::Clear() { std::ranges::fill(heights_, kUnseen); }

std::size_t HeightMapper::PlaceOf(std::int64_t x, std::int64_t y) {
  const auto wrapped = [](std::int64_t at) {
    return static_cast<std::size_t>((at % kCells + kCells) % kCells);
  };
  return wrapped(y) * kCells + wrapped(x);
}

void HeightMapper::Follow(const Eigen::Vector2d& p) {
  const std::int64_t x = CellOf(p.x()) - kCells / 2, y = CellOf(p.y()) - kCells / 2;
  const auto enters = [](std::int64_t now, std::int64_t then) {
    return now < then || now >= then + kCells;
  };
  if (x == x_ && y == y_) return;
  for (std::int64_t row = y; row < y + kCells; ++row) {
    for (std::int64_t column = x; column < x + kCells; ++column) {
      if (enters(column, x_) || enters(row, y_)) heights_[PlaceOf(column, row)] = kUnseen;
    }
  }
  x_ = x;
  y_ = y;
}

void HeightMapper::Add(const Eigen::Vector3d& p) {
  const std::int64_t x = CellOf(p.x()), y = CellOf(p.y());
  if (x < x_ || x >= x_ + kCells || y < y_ || y >= y_ + kCells) return;
  float& height = heights_[PlaceOf(x, y)];
  const double above = p.z() - height;
  if (height == kUnseen || above > kLevel) {
    height = static_cast<float>(p.z());
  } else if (above > -kLevel) {
    height += static_cast<float>(kShare * above);
  }
}

void HeightMapper::Read(robot::HeightMap* map) const {
  map->origin =
      robot::HeightMap::kCell * Eigen::Vector2d(static_cast<double>(x_), static_cast<double>(y_));
  map->heights.clear();
  for (std::int64_t y = y_; y < y_ + kCells; ++y) {
    for (std::int64_t x = x_; x < x_ + kCells; ++x) {
      map->heights.push_back(heights_[PlaceOf(x, y)]);
    }
  }
}

}  // namespace understudy::perception
