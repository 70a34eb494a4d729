// Where the base is and what the motion service does: SportModeState of the go family, which
// humanoids use too for their odometry, and that of the hg family.
#pragma once

#include <array>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// What a robot fills beside stamp, imu_state, position, body_height, velocity and yaw_speed.
enum class MotionFields : std::uint8_t {
  kNone,     // not a quadruped: nothing (*assumed*)
  kMode,     // firmware before RobotSpec::state_id_since: mode, progress and their kin
  kStateId,  // later: error_code is the state machine's id
};
MotionFields MotionFieldsOf(const robot::RobotSpec& spec);

// Writes one instant. In the world frame
// (*assumed*: no page states it), except yaw_speed, which is the gyro's z, the same float.
// stamp is simulated time since start (*assumed*). Nothing is estimated: position and velocity are
// the simulation's truth, without drift.
//
// kStateId is what a Go2 fills in 2026 (public capture of a real one, 2026-03): body_height is the
// height of the base over the world's ground plane (*assumed*; the capture shows 8 mm more than
// position z). kMode is what one filled in 2024 (capture of 2024-09): constant body_height,
// gait_type, foot_raise_height and range_obstacle, and foot_force as in LowState; its feet's
// positions are left 0 here. While no motion service is on both say that the robot is damped
// (*assumed*).
void EncodeMotion(const robot::RobotState& state, const robot::RobotSpec& spec, MotionFields fields,
                  unitree_go_msg_dds__SportModeState_* message);

// The state machine of a humanoid; state.motion must be there. task_id and task_time stay 0.
void EncodeFsm(const robot::RobotState& state, unitree_hg_msg_dds__SportModeState_* message);

// rt/arm/action/state: {"holding":true,"id":25,"name":"face wave"}; id 0 while there is none
// (unitree_sdk2 g1_arm_action_client.hpp). Does not allocate.
std::array<char, 96> ArmActionText(const robot::MotionState& motion);

}  // namespace understudy::wire
