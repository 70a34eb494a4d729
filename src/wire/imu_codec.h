// Encodes IMU readings. Both families have the same message except for the temperature's type.
#pragma once

#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "robot/robot_values.h"
#include "wire/roll_pitch_yaw.h"

namespace understudy::wire {

// Encodes a reading. Normalises the quaternion (w, x, y, z) and chooses the sign nearer to the
// previous quaternion in `message`, so that a stream does not jump; w >= 0 if `message` is all
// zero. A quaternion of length 0 or not finite becomes 1, 0, 0, 0. The temperature is rounded to
// °C, in go clamped to 0..127 (the vendor's Python packs a signed byte, its IDL has an unsigned
// one).
void EncodeImu(const robot::ImuReading& reading, unitree_go_msg_dds__IMUState_* message);
void EncodeImu(const robot::ImuReading& reading, unitree_hg_msg_dds__IMUState_* message);

}  // namespace understudy::wire
