// HandCmd_ and HandState_: hands with motors of their own, as the Dex3-1.
#pragma once

#include <span>
#include <vector>

#include "idl/unitree_hg.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// The mode byte of a hand's motor (RIS_Mode_t of unitree_sdk2 g1_dex3_example): id in bits 0 to 3,
// status in 4 to 6, 0 locked and 1 following; bit 7 of a command has the motor watched, of a state
// tells that a watched motor timed out (Dex3-1 page).
inline constexpr int kHandIds = 16;  // of motors, 0 to 15

// Reads a command into `command`, which takes the message's size where that fits, and tells the
// first thing wrong with its form, in this order: one entry per motor (kMotorCount; `command` is
// left as it was), each with its own place as id and a status of 0 or 1 (kMotorMode; `command` is
// filled, the id not looked at and any other status taken for 1). That a robot refuses such
// commands is *assumed*. `reserve` is not read.
robot::Refusal Decode(const unitree_hg_msg_dds__HandCmd_& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command);

// A message whose sequences point into memory of this class.
class HandStateMessage {
 public:
  // All zero but for what never changes: ids, pads and power_v.
  //
  // Each taxel that a pad has shows `kUntouched`, the others `kNoTaxel` (Dex3-1 page: 30000 is no
  // value, from 100000 on it is valid). That an untouched taxel shows the least valid value is
  // *assumed*; contacts are not felt. Nothing is known of a unit behind imu_state, which stays 0;
  // power_a, system_v, device_v and errors are not modelled and stay 0.
  explicit HandStateMessage(const robot::HandSpec& spec);
  HandStateMessage(HandStateMessage&&) = default;
  HandStateMessage& operator=(HandStateMessage&&) = default;

  // Of its motors, in their order; more than it has are not looked at.
  void Encode(std::span<const robot::MotorReading> reading);

  const unitree_hg_msg_dds__HandState_& message() const { return message_; }

  static constexpr float kUntouched = 100000;
  static constexpr float kNoTaxel = 30000;

 private:
  std::vector<unitree_hg_msg_dds__MotorState_> motors_;
  std::vector<unitree_hg_msg_dds__PressSensorState_> pads_;
  unitree_hg_msg_dds__HandState_ message_{};
};

}  // namespace understudy::wire
