// Encodes where a quadruped takes its base for, as the programs of its lidar tell it.
#pragma once

#include "idl/geometry_msgs.h"
#include "idl/nav_msgs.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Encode one instant in the frame `odom`, which begins where the robot booted. Each returns
// false while no motion service estimates: then nothing is sent, as on a real Go2. stamp is
// simulated time since start (*assumed*), covariances are 0 (seen). The velocity is in base_link,
// as in ROS (*assumed*). Texts belong to this program.
bool EncodeOdometry(const robot::RobotState& state, nav_msgs_msg_dds__Odometry_* message);
bool EncodePose(const robot::RobotState& state, geometry_msgs_msg_dds__PoseStamped_* message);

}  // namespace understudy::wire
