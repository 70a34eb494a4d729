// The interface between the control plane and what draws the pictures of a robot's cameras.
#pragma once

#include <cstddef>
#include <cstdint>
#include <future>
#include <span>

#include "base/bell.h"
#include "robot/robot_spec.h"
#include "services/picture_source.h"

namespace understudy::server {

// Of a camera's video stream, since the start.
struct VideoCounts {
  std::uint64_t sent = 0;    // frames
  std::uint64_t missed = 0;  // frames that were due while another was drawn
  std::uint64_t unsent = 0;  // packets that did not leave
};

// Pictures as the robot's own services give them, its cameras' faults included.
class CameraViews {
 public:
  virtual ~CameraViews() = default;

  virtual std::span<const robot::CameraSpec> cameras() const noexcept = 0;

  // Orders a picture by the camera of that number, of a state that is not older than this call, and
  // its depth if asked for. Any thread may call it. Looks may share a picture.
  virtual std::future<services::Picture> Look(std::size_t camera, bool depth) = 0;

  virtual VideoCounts video(std::size_t camera) const noexcept = 0;

  // Rung after pictures are there; the caller of Look answers it.
  virtual const Bell& news() const noexcept = 0;
};

}  // namespace understudy::server
