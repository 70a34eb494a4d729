// unitree_go: the low level of Go2, B2, their wheeled kin and H1.
#pragma once

#include "idl/unitree_go.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Head and level_flag left 0, as a client on the vendor's C++ library does that is meant for real
// Go2 (far-unitree-sdk 0.1.8). Taken; that a real robot takes it is *assumed*.
bool HeadIsUnset(const unitree_go_msg_dds__LowCmd_& message);

// Reads a command into `command`, which takes the robot's size, and tells the first thing
// wrong with its form, in this order: crc (kCrc), head FE EF and level_flag FF, or all three unset
// (kHead), the mode of
// a slot with a motor (kMotorMode). Modes are 0 stop, 1 servo, 0x0A servo of H1's strong motors.
// `command` is filled in any case; an unknown mode counts as enabled there. What the other fields
// hold (led, fan, gpio, bms_cmd, ...) is neither checked nor obeyed.
robot::Refusal Decode(const unitree_go_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command);

// Writes a state: all fields but those that stay 0 on real robots. Call it with the same message
// each time, all zero before the first (EncodeImu tells why). Slots without a motor stay as they
// are. Robots fill ddq and the raw fields with 0, and show mode 1 on a passive motor too
// (docs/sources.md#go2-captures).
//
// Not modelled: faults (reserve[0], bit_flag), lost packets, fans, foot_force_est, the board's
// thermometers.
void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_go_msg_dds__LowState_* message);

}  // namespace understudy::wire
