#include "wire/odometry_codec.h"

namespace understudy::wire {
namespace {

char odom_frame[] = "odom", base_frame[] = "base_link";

void EncodeHeader(const robot::RobotState& state, std_msgs_msg_dds__Header_* header) {
  header->stamp.sec = static_cast<std::int32_t>(state.tick_ms / 1000);
  header->stamp.nanosec = static_cast<std::uint32_t>(state.tick_ms % 1000) * 1'000'000;
  header->frame_id = odom_frame;
}

void EncodeVector(const Eigen::Vector3d& value, geometry_msgs_msg_dds__Vector3_* message) {
  *message = {.x = value.x(), .y = value.y(), .z = value.z()};
}

void EncodeBase(const robot::LegOdometry& odometry, geometry_msgs_msg_dds__Pose_* message) {
  const Eigen::Vector3d& p = odometry.p_OB;
  const Eigen::Quaterniond& R = odometry.R_OB;  // NOLINT(readability-identifier-naming): a rotation
  message->position = {.x = p.x(), .y = p.y(), .z = p.z()};
  message->orientation = {.x = R.x(), .y = R.y(), .z = R.z(), .w = R.w()};
}

}  // namespace

bool EncodeOdometry(const robot::RobotState& state, nav_msgs_msg_dds__Odometry_* message) {
  if (!state.leg_odometry) return false;
  EncodeHeader(state, &message->header);
  message->child_frame_id = base_frame;
  EncodeBase(*state.leg_odometry, &message->pose.pose);
  EncodeVector(state.leg_odometry->v_OB_B, &message->twist.twist.linear);
  EncodeVector(state.imu.w_WI_I, &message->twist.twist.angular);
  return true;
}

bool EncodePose(const robot::RobotState& state, geometry_msgs_msg_dds__PoseStamped_* message) {
  if (!state.leg_odometry) return false;
  EncodeHeader(state, &message->header);
  EncodeBase(*state.leg_odometry, &message->pose);
  return true;
}

}  // namespace understudy::wire
