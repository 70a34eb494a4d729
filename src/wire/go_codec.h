// Encodes and decodes the low-level messages of the go family: Go2, Go2-W, B2, B2-W and H1.
#pragma once

#include "idl/unitree_go.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Returns whether head and level_flag are 0, as in commands of a client for real Go2
// (far-unitree-sdk 0.1.8). They are taken; that a real robot takes them is *assumed*.
bool HeadIsUnset(const unitree_go_msg_dds__LowCmd_& message);

// Decodes a message into `command`, resized to the robot's motors, and returns the first fault of
// form in this order: crc (kCrc); head FE EF and level_flag FF, or all three 0 (kHead); the mode of
// a slot with a motor (kMotorMode). Modes are 0 stop, 1 servo, 0x0A servo of H1's strong motors.
// `command` is always filled in; an unknown mode counts as enabled. Other fields (led, fan, gpio,
// bms_cmd, ...) are ignored.
robot::Refusal Decode(const unitree_go_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command);

// Returns the bits of LowState's bit_flag that report faults: of motors that do not answer and of
// the mainboard's small controller.
std::uint8_t BottomFaults(const robot::RobotState& state);

// Encodes a state, without the fields that are 0 on real robots. Call it with the same message each
// time, all zero before the first (see EncodeImu). Slots without a motor do not change. As on real
// robots, ddq and the raw fields are 0, and a passive motor has mode 1 too
// (docs/dev/sources.md#go2-captures).
//
// Not modelled: foot_force_est.
void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_go_msg_dds__LowState_* message);

}  // namespace understudy::wire
