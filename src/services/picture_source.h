// The interface between the services of a robot and what draws the pictures of its cameras.
#pragma once

#include <cstdint>
#include <memory>
#include <string_view>
#include <vector>

namespace understudy::services {

using PictureBytes = std::shared_ptr<const std::vector<std::uint8_t>>;

// What came of an order.
struct Picture {
  enum class Outcome : std::uint8_t {
    kDrawn,
    kLost,    // the camera gives none this time
    kFailed,  // it cannot be drawn
  };
  std::uint64_t order = 0;
  Outcome outcome = Outcome::kFailed;
  PictureBytes jpeg{};   // null unless drawn
  PictureBytes depth{};  // PNG of 16 bits, mm; null unless drawn and looked for
};

// Draws pictures in another thread. Polled by the tick; no function waits or throws.
class PictureSource {
 public:
  using Order = std::uint64_t;  // 0 is none

  virtual ~PictureSource() = default;

  // Orders a picture by the camera of that service, of a state that is not older than this call.
  // Calls may get the same order. Returns 0 if the robot has no such camera.
  virtual Order Begin(std::string_view service) noexcept = 0;

  // Returns the next order that is done, or null; valid until Pop.
  virtual const Picture* Front() const noexcept = 0;
  virtual void Pop() noexcept = 0;
};

}  // namespace understudy::services
