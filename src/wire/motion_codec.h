// Where the base is and how it moves: SportModeState of the go family, which humanoids use too.
#ifndef UNDERSTUDY_WIRE_MOTION_CODEC_H_
#define UNDERSTUDY_WIRE_MOTION_CODEC_H_

#include "idl/unitree_go.h"
#include "robot/robot_values.h"

namespace understudy {

// Writes what firmware of 2026 fills (public capture of a real Go2, 2026-03): stamp, error_code,
// imu_state, position, body_height, velocity and yaw_speed; the rest stays 0. In the world frame
// (*assumed*: no page states it), except yaw_speed, which is the gyro's z, the same float.
// body_height is the height of the base over the world's ground plane (*assumed*; the capture shows
// 8 mm more than position z). stamp is simulated time since start (*assumed*). error_code names the
// state machine's state: 1001, damping, since no motion service runs.
//
// Nothing is estimated: position and velocity are the simulation's truth, without drift.
void EncodeMotion(const RobotState& state, unitree_go_msg_dds__SportModeState_* message);

}  // namespace understudy

#endif  // UNDERSTUDY_WIRE_MOTION_CODEC_H_
