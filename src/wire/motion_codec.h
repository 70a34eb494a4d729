// Encodes motion states: SportModeState of the go family, which humanoids also use for odometry,
// and SportModeState of the hg family.
#pragma once

#include <array>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Which fields a robot fills besides stamp, imu_state, position, body_height, velocity and
// yaw_speed.
enum class MotionFields : std::uint8_t {
  kNone,     // not a quadruped: none (*assumed*)
  kMode,     // firmware before RobotSpec::state_id_since: mode, progress, gait_type, ...
  kStateId,  // later: error_code is the state machine's id
};
MotionFields MotionFieldsOf(const robot::RobotSpec& spec);

// Encodes one instant, in the world frame (*assumed*, as it is not documented); yaw_speed is the z
// of imu_state's gyroscope. stamp is simulated time since start (*assumed*). Position and velocity
// are the estimate of the motion service if it has one (MotionState::estimates), else the
// simulation's truth, without drift.
//
// kStateId has the fields of a Go2 of 2026 (public captures of two real ones); body_height is 8.5
// mm over position z, as in those. kMode has those of a Go2 of 2024 (capture of 2024-09): constant
// body_height, gait_type, foot_raise_height and range_obstacle, foot_force as in LowState, and, if
// the service estimates, the gait and the height that are set, and the feet. While no motion
// service is on, both report a damped robot (*assumed*). In the odometry of hg robots stamp and
// body_height are 0, as seen on a G1.
void EncodeMotion(const robot::RobotState& state, const robot::RobotSpec& spec, MotionFields fields,
                  unitree_go_msg_dds__SportModeState_* message);

// Encodes the state machine of a humanoid. state.motion must have a value. task_id is 4 and
// task_time 0, as an idle G1 tells them.
void EncodeFsm(const robot::RobotState& state, unitree_hg_msg_dds__SportModeState_* message);

// Returns the text of rt/arm/action/state, blanks as on a real G1:
// {"holding": true, "id": 27, "name": "shake_hand"}; id 99 after a release until the next action,
// and 0 before the first. Does not allocate.
std::array<char, 96> ArmActionText(const robot::MotionState& motion);

}  // namespace understudy::wire
