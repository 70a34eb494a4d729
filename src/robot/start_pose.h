// The start poses of a robot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

namespace understudy::robot {

enum class StartPose : std::uint8_t {
  kLying,     // on the ground, braking
  kStanding,  // held by its motors
  kHanging,   // on the crane
  kClamped,   // the base fixed in the air
};

inline constexpr std::array<std::string_view, 4> kStartPoses = {"lying", "standing", "hanging",
                                                                "clamped"};

constexpr std::optional<StartPose> FindStartPose(std::string_view word) {
  for (std::size_t i = 0; i < kStartPoses.size(); ++i) {
    if (kStartPoses[i] == word) return static_cast<StartPose>(i);
  }
  return std::nullopt;
}

}  // namespace understudy::robot
