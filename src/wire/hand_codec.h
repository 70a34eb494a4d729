// Encodes and decodes the messages of hands: HandCmd_ and HandState_ of the Dex3-1, MotorCmds_ and
// MotorStates_ of others.
#pragma once

#include <span>
#include <vector>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// The mode byte of a hand's motor (RIS_Mode_t of unitree_sdk2 g1_dex3_example): bits 0 to 3 are the
// id, 4 to 6 the status, 0 locked and 1 following; bit 7 of a command has the motor watched, in a
// state it means that a watched motor has timed out (Dex3-1 page).
inline constexpr int kHandIds = 16;  // of motors, 0 to 15

// Decodes a message into `command` and returns the first fault of form. kMotorCount: not one entry
// per motor; `command` does not change. kMotorMode: an id that is not the entry's index, or a
// status other than 0 and 1; `command` is filled in, ignoring the ids and taking other statuses for
// 1. That a robot refuses such commands is *assumed*. `reserve` is ignored.
robot::Refusal Decode(const unitree_hg_msg_dds__HandCmd_& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command);

// Decodes the motors from spec.slot on into `command`. Every motor is enabled, since the services
// of hands ignore the mode. Of a motor with a span, q and dq are cut to 0 and 1; dq is the share of
// its knee_speed. Returns kMotorCount for fewer motors than the messages have, of which the
// services would read what is not there; further ones are ignored, as by them.
robot::Refusal Decode(const unitree_go_msg_dds__MotorCmds_& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command);

// Decodes a message of rt/hand_sdk to the motors of all hands, in motor order; those of hands
// without an sdk_slot stay as they are by default. Every motor is enabled and not watched. The
// weight is the mode of the first entry, in percent. A positive q, dq or tau closes, while the
// joints of hands open so (the vendor's page hand_sdk). Returns kMotorCount for fewer than
// kHandSdkMotors; further ones are ignored, which is *assumed*.
robot::Refusal DecodeHandSdk(const unitree_go_msg_dds__MotorCmds_& message,
                             const robot::RobotSpec& spec, robot::RobotCommand* command);

// A HandState_ and the memory of its sequences.
class HandStateMessage {
 public:
  // Sets what never changes, ids, pads and power_v; all else is 0.
  //
  // The taxels of a pad are `kUntouched`, the others `kNoTaxel` (Dex3-1 page: 30000 is no value,
  // valid ones start at 100000). That an untouched taxel has the least valid value is *assumed*.
  // imu_state stays 0, as no unit is known; power_a, system_v, device_v
  // and errors are not modelled and stay 0.
  explicit HandStateMessage(const robot::HandSpec& spec);

  // Encodes the readings of its motors, in their order; ignores further ones.
  void Encode(std::span<const robot::MotorReading> reading);

  // Encodes what the cells of its pads show, in their order; ignores further ones. That counts add
  // to kUntouched is *assumed*, as is their scale (config/hands/dex3.yaml).
  void EncodeTouch(std::span<const float> counts);

  // Returns the message, whose sequences are of this object and valid as long as it is.
  unitree_hg_msg_dds__HandState_ message();

  static constexpr float kUntouched = 100000;
  static constexpr float kNoTaxel = 30000;

 private:
  struct Taxel {
    std::size_t pad = 0, place = 0;  // in the message
    std::size_t cell = 0;            // among those of the hand
  };

  std::vector<unitree_hg_msg_dds__MotorState_> motors_;
  std::vector<unitree_hg_msg_dds__PressSensorState_> pads_;
  std::vector<Taxel> taxels_;
  unitree_hg_msg_dds__HandState_ message_{};
};

// A MotorStates_ and the memory of its sequence. All that a service leaves out is 0.
class MotorStatesMessage {
 public:
  // `spec` must outlive this object.
  explicit MotorStatesMessage(const robot::HandSpec& spec);

  // Encodes the readings of its motors, in their order; ignores further ones. Of a motor with a
  // span, q, dq and tau_est are shares of span, knee_speed and torque_limit, in steps of 0.001,
  // and positive from q 0 to 1. That tau_est is such a share is *assumed*.
  void Encode(std::span<const robot::MotorReading> reading);

  // Returns the message, whose sequence is of this object and valid as long as it is.
  unitree_go_msg_dds__MotorStates_ message();

 private:
  const robot::HandSpec& spec_;
  std::vector<unitree_go_msg_dds__MotorState_> motors_;
};

}  // namespace understudy::wire
