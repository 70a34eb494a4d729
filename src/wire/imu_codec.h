// The inertial unit's part of states, the same in both families but for the temperature's type.
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Roll, pitch, yaw [rad] of a unit quaternion: R = Rz(yaw) Ry(pitch) Rx(roll). Pitch lies in ±π/2,
// roll and yaw in ±π. Never NaN for finite input; at pitch ±π/2, where only the sum or difference
// of roll and yaw is determined, each is some finite value.
Eigen::Vector3d RollPitchYaw(const Eigen::Quaterniond& R_WI);

// Writes a reading. The quaternion (w, x, y, z) is normalised, and of its two signs has the one
// that is nearer to what `message` holds from before, so that a stream does not jump; w >= 0 in an
// all-zero message. A quaternion of length 0 or not finite becomes 1, 0, 0, 0. The temperature is
// rounded to °C; go has 0..127 (the vendor's Python packs a signed byte, its IDL says unsigned).
void EncodeImu(const robot::ImuReading& reading, unitree_go_msg_dds__IMUState_* message);
void EncodeImu(const robot::ImuReading& reading, unitree_hg_msg_dds__IMUState_* message);

}  // namespace understudy::wire
