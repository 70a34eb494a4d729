// The interface between the control plane and what draws the pictures of a robot's cameras.
#pragma once

#include <cstddef>
#include <future>
#include <span>

#include "base/bell.h"
#include "robot/robot_spec.h"
#include "services/picture_source.h"

namespace understudy::server {

// Pictures as the robot's own services give them, its cameras' faults included.
class CameraViews {
 public:
  virtual ~CameraViews() = default;

  virtual std::span<const robot::CameraSpec> cameras() const noexcept = 0;

  // Orders a picture by the camera of that number, of a state that is not older than this call. Any
  // thread may call it. Looks may share a picture.
  virtual std::future<services::Picture> Look(std::size_t camera) = 0;

  // Rung after pictures are there; the caller of Look answers it.
  virtual const Bell& news() const noexcept = 0;
};

}  // namespace understudy::server
