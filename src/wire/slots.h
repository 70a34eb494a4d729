// Converts between motors and the slots of messages.
#pragma once

#include <cstddef>
#include <cstdint>
#include <iterator>

#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

inline constexpr std::size_t kGoMotorSlots = 20;
inline constexpr std::size_t kHgMotorSlots = 35;
inline constexpr std::size_t kGoCells = 15;  // battery cells of a message
inline constexpr std::size_t kHgCells = 40;

// Throws ModelError unless the motors have ascending slots below `slots` and the battery has
// 1..cells cells.
void CheckFits(const robot::RobotSpec& spec, std::size_t slots, std::size_t cells);

// A motor's slot as an index.
inline std::size_t SlotOf(const robot::MotorSpec& motor) {
  return static_cast<std::size_t>(motor.slot);
}

// Decodes a slot of either family's LowCmd. The marks for "no position" and "no velocity" are exact
// in float and become kNoPosition and kNoVelocity.
template <typename MotorCmd>
robot::MotorCommand DecodeMotor(const MotorCmd& wire) {
  static_assert(static_cast<double>(2.146e9F) == robot::kNoPosition);
  static_assert(static_cast<double>(16000.0F) == robot::kNoVelocity);
  return {.enabled = wire.mode != 0,
          .q = wire.q,
          .dq = wire.dq,
          .tau = wire.tau,
          .kp = wire.kp,
          .kd = wire.kd};
}

// Returns the weight of a command of rt/arm_sdk as sent, without limits or checks.
template <typename LowCmd>
double ArmWeight(const LowCmd& message, const robot::ArmSdkSpec& spec) {
  if constexpr (requires { message.mode_pr; }) {
    if (spec.weight_in_mode_pr) return message.mode_pr / 100.0;
  }
  return message.motor_cmd[static_cast<std::size_t>(spec.weight_slot)].q;
}

// Decodes a command of rt/arm_sdk or rt/user_lowcmd. Its form is never refused: crc and modes are
// ignored. Every motor counts as enabled, since the vendor's clients leave the mode 0, and as
// commanded in PR.
template <typename LowCmd>
robot::Refusal DecodeUnsigned(const LowCmd& message, const robot::RobotSpec& spec,
                              robot::RobotCommand* command) {
  command->motors.resize(spec.motors.size());
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    command->motors[i] = DecodeMotor(message.motor_cmd[SlotOf(spec.motors[i])]);
    command->motors[i].enabled = true;
  }
  command->weight = ArmWeight(message, spec.arm_sdk);
  return robot::Refusal::kNone;
}

// What a LowCmd has in slots without a motor.
struct UnusedSlots {
  std::uint64_t count = 0;  // of those with gains or torque
  // They are commanded differently, or only some of them: the program means other motors by them.
  // Programs that fill all slots alike are common (the vendor's xr_teleoperate is one).
  bool differ = false;
};

template <typename LowCmd>
UnusedSlots UnusedSlotCommands(const LowCmd& message, const robot::RobotSpec& spec) {
  UnusedSlots unused;
  const auto same = [](const auto& a, const auto& b) {
    return a.q == b.q && a.dq == b.dq && a.kp == b.kp && a.kd == b.kd && a.tau == b.tau;
  };
  const auto* first = std::end(message.motor_cmd);
  auto motor = spec.motors.begin();
  int slot = 0;
  for (const auto& wire : message.motor_cmd) {
    if (motor != spec.motors.end() && motor->slot == slot++) {
      ++motor;
      continue;
    }
    if (first == std::end(message.motor_cmd)) first = &wire;
    if (wire.kp != 0 || wire.kd != 0 || wire.tau != 0) ++unused.count;
    unused.differ = unused.differ || !same(wire, *first);
  }
  unused.differ = unused.differ && unused.count > 0;
  return unused;
}

}  // namespace understudy::wire
