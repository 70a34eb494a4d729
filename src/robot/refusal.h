// Why a command was not taken.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::robot {

enum class Refusal : std::uint8_t {
  kNone,
  kCrc,              // the crc word does not fit the rest
  kHead,             // go: head is not FE EF, or level_flag not FF
  kModeMachine,      // hg: not the machine LowState announces
  kModePr,           // hg: neither PR (0) nor AB (1)
  kMotorMode,        // a motor's mode byte is none that the robot knows
  kMotorCount,       // hands: other than one entry per motor
  kNotFinite,        // NaN or infinity in a motor's command
  kGain,             // a negative kp or kd
  kMotionService,    // the robot's own motion service moves the motors
  kNoMotionService,  // rt/arm_sdk, rt/user_lowcmd: none is on
  kNotHandedOver,    // rt/user_lowcmd: the motion service keeps the motors
  kUndecoded,        // no message of the topic's type
  kCount,
};

inline constexpr std::size_t kRefusals = static_cast<std::size_t>(Refusal::kCount);

// The word that logs, counters and the control plane use.
constexpr std::string_view Name(Refusal refusal) {
  constexpr std::array<std::string_view, kRefusals> kNames = {
      "none",        "crc",        "head", "mode_machine",   "mode_pr",           "motor_mode",
      "motor_count", "not_finite", "gain", "motion_service", "no_motion_service", "not_handed_over",
      "undecoded"};
  return kNames[static_cast<std::size_t>(refusal)];
}

// Whether nothing can be made of such a command, however lenient one is.
constexpr bool IsUnreadable(Refusal refusal) {
  return refusal == Refusal::kMotorCount || refusal == Refusal::kUndecoded;
}

}  // namespace understudy::robot
