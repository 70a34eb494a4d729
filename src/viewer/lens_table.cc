#include "viewer/lens_table.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "robot/lens.h"

namespace understudy::viewer {
namespace {

constexpr int kRun = 16;  // pixels of a row over which directions change evenly, to 0.05 of one
constexpr int kMostPixels = 8192;  // along a side; more no OpenGL needs to have

}  // namespace

LensTable::LensTable(const robot::CameraSpec& camera) : range_(camera.depth) {
  const Eigen::Vector2d reach = robot::ReachOf(camera);
  const double focal = std::max(camera.focal[0], camera.focal[1]);
  const auto pixels = [](double length) {
    return static_cast<int>(std::clamp(std::ceil(length), 2.0, double{kMostPixels}));
  };
  straight_.height = pixels(2 * reach.y() * focal);
  straight_.width = pixels(straight_.height * reach.x() / reach.y());
  const double scale = straight_.height / (2 * reach.y());  // its focal length

  bent_.width = camera.width;
  bent_.height = camera.height;
  const std::size_t count =
      static_cast<std::size_t>(bent_.width) * static_cast<std::size_t>(bent_.height);
  bent_.rgb.resize(3 * count);
  sources_.reserve(count);
  for (int v = 0; v < bent_.height; ++v) {
    Eigen::Vector2d next = robot::DirectionOf(camera, Eigen::Vector2d(0, v));
    for (int u = 0; u < bent_.width; u += kRun) {
      const Eigen::Vector2d first = next;
      next = robot::DirectionOf(camera, Eigen::Vector2d(u + kRun, v));
      for (int i = 0; i < std::min(kRun, bent_.width - u); ++i) {
        sources_.push_back(SourceAt(scale * (first + (next - first) * i / kRun)));
      }
    }
  }
}

// `at` counts from the middle of the straight picture.
LensTable::Source LensTable::SourceAt(const Eigen::Vector2d& at) const {
  // Up to the last pixel but one, of which all four neighbours are there.
  const auto within = [](double place, int count) {
    return std::clamp(place + (count - 1) / 2.0, 0.0, count - 1 - 1.0 / 256);
  };
  const double x = within(at.x(), straight_.width);
  const double y = within(at.y(), straight_.height);
  const auto left = static_cast<std::int32_t>(x), top = static_cast<std::int32_t>(y);
  return {.offset = 3 * (top * straight_.width + left),
          .right = static_cast<std::uint8_t>(256 * (x - left)),
          .down = static_cast<std::uint8_t>(256 * (y - top))};
}

const Image& LensTable::Bend(const Image& straight, double light) {
  std::array<std::uint8_t, 256> seen{};
  for (std::size_t i = 0; i < seen.size(); ++i) {
    seen[i] = static_cast<std::uint8_t>(std::lround(static_cast<double>(i) * light));
  }
  const std::ptrdiff_t below = std::ptrdiff_t{3} * straight_.width;
  std::uint8_t* out = bent_.rgb.data();
  for (const Source& source : sources_) {
    const std::uint8_t* in = straight.rgb.data() + source.offset;
    const int right = source.right, down = source.down;
    for (int c = 0; c < 3; ++c, ++in) {
      const int upper = in[0] * (256 - right) + in[3] * right;
      const int lower = in[below] * (256 - right) + in[below + 3] * right;
      *out++ = seen[static_cast<std::size_t>((upper * (256 - down) + lower * down + 32768) >> 16)];
    }
  }
  return bent_;
}

DepthImage LensTable::BendDepths(const std::vector<float>& straight) const {
  DepthImage depths{.width = bent_.width, .height = bent_.height, .mm = {}};
  depths.mm.reserve(sources_.size());
  for (const Source& source : sources_) {
    const int at = source.offset / 3 + (source.right < 128 ? 0 : 1) +
                   (source.down < 128 ? 0 : straight_.width);
    const double depth = straight[static_cast<std::size_t>(at)];
    const bool within = depth >= range_[0] && depth <= range_[1];
    depths.mm.push_back(within ? static_cast<std::uint16_t>(std::lround(1000 * depth)) : 0);
  }
  return depths;
}

}  // namespace understudy::viewer
