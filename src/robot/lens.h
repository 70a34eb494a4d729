// The lens of a camera, by the model that OpenCV calibrates.
#pragma once

#include <Eigen/Core>

#include "robot/robot_spec.h"

namespace understudy::robot {

// A direction of view: how far to the right and down it goes per length along the camera's axis.
// Pixels count to the right and down; the first one's middle is 0, 0.

// Returns where a direction is seen. That the light bends by
//   x' = x (1 + k1 r² + k2 r⁴) + 2 p1 x y + p2 (r² + 2 x²)
//   y' = y (1 + k1 r² + k2 r⁴) + p1 (r² + 2 y²) + 2 p2 x y
// holds in the picture and some way beyond.
Eigen::Vector2d PixelOf(const CameraSpec& camera, const Eigen::Vector2d& direction);

// Returns the direction that a pixel of the picture shows. PixelOf tells whether there is one.
Eigen::Vector2d DirectionOf(const CameraSpec& camera, const Eigen::Vector2d& pixel);

// Returns the largest of both numbers, in magnitude, of the directions in the picture.
Eigen::Vector2d ReachOf(const CameraSpec& camera);

}  // namespace understudy::robot
