#include "perception/voxel_mapper.h"

#include <algorithm>
#include <cmath>

namespace understudy::perception {
namespace {

constexpr int kAcross = robot::VoxelMap::kAcross;
constexpr int kCloudsKept = 38;  // 2.5 s

std::int64_t CubeOf(double at) {
  return static_cast<std::int64_t>(std::floor(at / robot::VoxelMap::kCell));
}
std::int64_t Lowest() { return CubeOf(robot::VoxelMap::kLowest); }

std::size_t Wrapped(std::int64_t at) {
  return static_cast<std::size_t>((at % kAcross + kAcross) % kAcross);
}

std::uint64_t BitOf(std::size_t x) { return std::uint64_t{1} << (63 - x % 64); }

}  // namespace

void VoxelMapper::Clear() {
  if (clouds_ == 0) return;
  std::ranges::fill(now_, Row{});
  std::ranges::fill(before_, Row{});
  clouds_ = 0;
}

void VoxelMapper::Begin(const Eigen::Vector2d& p) {
  const std::size_t rows = static_cast<std::size_t>(kAcross) * kUp;
  now_.resize(rows);
  before_.resize(rows);
  if (++clouds_ > kCloudsKept) {
    std::swap(now_, before_);
    std::ranges::fill(now_, Row{});
    clouds_ = 1;
  }
  ForgetWhatIsLeft(CubeOf(p.x()) - kAcross / 2, CubeOf(p.y()) - kAcross / 2);
}

void VoxelMapper::ForgetWhatIsLeft(std::int64_t x, std::int64_t y) {
  if (x == x_ && y == y_) return;
  const auto enters = [](std::int64_t now, std::int64_t then) {
    return now < then || now >= then + kAcross;
  };
  Row stays{};
  for (std::int64_t column = x; column < x + kAcross; ++column) {
    const std::size_t place = Wrapped(column);
    if (!enters(column, x_)) stays[place / 64] |= BitOf(place);
  }
  for (Cubes* const cubes : {&now_, &before_}) {
    for (std::int64_t row = y; row < y + kAcross; ++row) {
      for (std::size_t z = 0; z < kUp; ++z) {
        Row& bits = (*cubes)[z * kAcross + Wrapped(row)];
        for (std::size_t word = 0; word < bits.size(); ++word) {
          bits[word] &= enters(row, y_) ? 0 : stays[word];
        }
      }
    }
  }
  x_ = x;
  y_ = y;
}

void VoxelMapper::Add(const Eigen::Vector3d& p) {
  const std::int64_t x = CubeOf(p.x()), y = CubeOf(p.y()), z = CubeOf(p.z()) - Lowest();
  if (x < x_ || x >= x_ + kAcross || y < y_ || y >= y_ + kAcross || z < 0 || z >= kUp) return;
  const std::size_t place = Wrapped(x);
  now_[static_cast<std::size_t>(z) * kAcross + Wrapped(y)][place / 64] |= BitOf(place);
}

void VoxelMapper::Read(robot::VoxelMap* map) const {
  const auto middle = [](std::int64_t cube) {
    return (static_cast<double>(cube) + 0.5) * robot::VoxelMap::kCell;
  };
  map->origin = {middle(x_), middle(y_), middle(Lowest())};
  map->bits.clear();
  if (now_.empty()) map->bits.resize(static_cast<std::size_t>(kUp) * kAcross * kAcross / 8);
  const std::size_t first = Wrapped(x_), shift = first % 64;
  for (std::size_t row = 0; row < now_.size(); ++row) {
    const std::size_t at =
        row / kAcross * kAcross + Wrapped(y_ + static_cast<std::int64_t>(row % kAcross));
    for (std::size_t word = 0; word < 2; ++word) {
      const auto of = [&](std::size_t i) {
        return now_[at][(first / 64 + i) % 2] | before_[at][(first / 64 + i) % 2];
      };
      std::uint64_t bits = of(word) << shift;
      if (shift != 0) bits |= of(word + 1) >> (64 - shift);
      for (int byte = 56; byte >= 0; byte -= 8) {
        map->bits.push_back(static_cast<std::uint8_t>(bits >> byte));
      }
    }
  }
}

}  // namespace understudy::perception
