// The reasons for which a command is refused.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace understudy::robot {

enum class Refusal : std::uint8_t {
  kNone,
  kCrc,              // the crc does not fit the message
  kHead,             // go: head is not FE EF, or level_flag not FF
  kModeMachine,      // hg: not that of LowState
  kModePr,           // hg: neither PR (0) nor AB (1)
  kMotorMode,        // a motor's mode byte is unknown
  kMotorCount,       // not one entry per motor
  kNotFinite,        // NaN or infinity in a motor's command
  kGain,             // a negative kp or kd
  kMotionService,    // a motion service moves the motors
  kNoMotionService,  // rt/arm_sdk, rt/hand_sdk, rt/user_lowcmd: none is on
  kNotHandedOver,    // rt/user_lowcmd: the motion service has not handed over the motors
  kDamping,          // rt/hand_sdk: the motion service damps
  kUndecoded,        // not a message of the topic's type
  kLost,             // replaced by newer ones before it was read, or lost by the bus
  kUnmatched,        // counts writers, of another type or quality of service than the topic's
  kCount,
};

inline constexpr std::size_t kRefusals = static_cast<std::size_t>(Refusal::kCount);

// Returns the word for logs, counters and the control plane.
constexpr std::string_view Name(Refusal refusal) {
  constexpr std::array<std::string_view, kRefusals> kNames = {
      "none",        "crc",        "head", "mode_machine",   "mode_pr",           "motor_mode",
      "motor_count", "not_finite", "gain", "motion_service", "no_motion_service", "not_handed_over",
      "damping",     "undecoded",  "lost", "unmatched"};
  return kNames[static_cast<std::size_t>(refusal)];
}

// Returns whether such a command cannot be read, so that even a lenient intake refuses it.
constexpr bool IsUnreadable(Refusal refusal) {
  return refusal == Refusal::kMotorCount || refusal == Refusal::kUndecoded;
}

}  // namespace understudy::robot
