// unitree_hg: the low level of G1, H1-2, H2 and R1.
#pragma once

#include "idl/unitree_hg.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Reads a command into `command`, which takes the robot's size, and tells the first thing
// wrong with its form, in this order: crc (kCrc), mode_machine equal to the robot's (kModeMachine),
// mode_pr 0 or 1 (kModePr), the mode of a slot with a motor, 0 or 1 (kMotorMode). `command` is
// filled in any case; an unknown mode_pr counts as PR there, an unknown mode as enabled.
robot::Refusal Decode(const unitree_hg_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command);

// Writes a state: all fields but those that stay 0 on real robots. Call it with the same message
// each time, all zero before the first (EncodeImu tells why). Slots without a motor stay as they
// are. With state.joint_space kMotors the parallel pairs show their motors: B in the slot of pitch,
// A in that of roll, torques mapped so that power is the same.
//
// `vol` is the bus voltage, in the steps of 0.5 V seen (docs/sources.md#g1-logs). Not modelled:
// faults (motorstate), the sensor words.
void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_hg_msg_dds__LowState_* message);

// Writes the battery's message. No vendor page documents its fields: cell_vol and bmsvoltage[0] in
// mV, current in mA, soc and soh in percent and all temperatures that of the pack are *assumed*, by
// the go family's units. Versions, fn, cycle, date and state words stay 0.
void EncodeBms(const robot::RobotState& state, const robot::RobotSpec& spec,
               unitree_hg_msg_dds__BmsState_* message);

}  // namespace understudy::wire
