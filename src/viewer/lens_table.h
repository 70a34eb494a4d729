// Turns pictures as OpenGL draws them, without a lens, into those of a camera.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "robot/robot_spec.h"
#include "viewer/canvas.h"

namespace understudy::viewer {

class LensTable {
 public:
  explicit LensTable(const robot::CameraSpec& camera);

  // The size of the straight picture: as fine as the camera's in its middle, and wide enough for
  // its corners. Its vertical field of view is that of the model's camera (mjcf::AddCameras).
  const PictureSize& straight() const { return straight_; }

  // Returns the camera's picture of a straight one, with that share of its light.
  const Image& Bend(const Image& straight, double light);

  // Returns the camera's depths of straight ones [m]: each that of the nearest pixel, 0 outside the
  // camera's range.
  DepthImage BendDepths(const std::vector<float>& straight) const;

 private:
  // Where a pixel comes from: the upper left of four pixels, and how far into them, in 1/256.
  struct Source {
    std::int32_t offset = 0;  // in Image::rgb
    std::uint8_t right = 0, down = 0;
  };

  Source SourceAt(const Eigen::Vector2d& at) const;

  std::array<double, 2> range_;  // m, of depths
  PictureSize straight_;
  std::vector<Source> sources_;  // by pixel
  Image bent_;
};

}  // namespace understudy::viewer
