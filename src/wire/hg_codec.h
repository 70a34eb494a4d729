// Encodes and decodes the low-level messages of the hg family: G1, H1-2, H2 and R1.
#pragma once

#include "idl/unitree_hg.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Decodes a message into `command`, resized to the robot's motors, and returns the first fault of
// form in this order: crc (kCrc); mode_machine differs from the robot's (kModeMachine); mode_pr is
// not 0 or 1 (kModePr); the mode of a slot with a motor is not 0 or 1 (kMotorMode). `command` is
// always filled in; an unknown mode_pr counts as PR, an unknown mode as enabled.
robot::Refusal Decode(const unitree_hg_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command);

// Encodes a state, without the fields that are 0 on real robots. Call it with the same message each
// time, all zero before the first (see EncodeImu). Slots without a motor do not change. With
// state.joint_space kMotors the slots of parallel pairs have the values of their motors, B in the
// slot of pitch and A in that of roll, with torques of equal power.
//
// `vol` is the bus voltage in steps of 0.5 V, as seen on a G1 (docs/dev/sources.md#g1-logs). Not
// modelled: faults (motorstate), the sensor words.
void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_hg_msg_dds__LowState_* message);

// Encodes the battery's message. Its fields are not documented. Units as in the go family are
// *assumed*: cell_vol and bmsvoltage[0] in mV, current in mA, soc and soh in percent; all
// temperatures are that of the pack. Versions, fn, cycle, date and state words stay 0.
void EncodeBms(const robot::RobotState& state, const robot::RobotSpec& spec,
               unitree_hg_msg_dds__BmsState_* message);

}  // namespace understudy::wire
