#include "wire/motion_codec.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <string_view>

#include "robot/arm_actions.h"
#include "robot/firmware.h"
#include "wire/imu_codec.h"
#include "wire/rounded.h"

namespace understudy::wire {
namespace {

constexpr std::uint32_t kDampedId = 1001;  // vendor, Go2 motion services V2.0; assumed on others
constexpr std::uint8_t kDampedMode = 7;    // vendor, Go2 sports services
// A damped Go2 of 2024-09, public capture.
constexpr std::uint8_t kGait = 1;
constexpr float kFootRaise = 0.09F;   // m
constexpr float kBodyHeight = 0.32F;  // m
// Two Go2 with mcf, standing: 0.3118 over 0.3034 and 0.322 over 0.313, public captures.
constexpr float kHeightOverPosition = 0.0085F;  // m
constexpr std::uint32_t kIdleTask = 4;          // an idle G1, firmware 1.4.7

// What a service that estimates knows of its gait and feet.
void EncodeGait(const robot::MotionState& motion, unitree_go_msg_dds__SportModeState_* message) {
  message->gait_type = static_cast<std::uint8_t>(motion.gait);
  message->body_height = static_cast<float>(motion.wanted_height);
  if (motion.foot_raise > 0) message->foot_raise_height = static_cast<float>(motion.foot_raise);
  for (std::size_t foot = 0; foot < motion.feet.size(); ++foot) {
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t slot = 3 * foot + static_cast<std::size_t>(axis);
      message->foot_position_body[slot] = static_cast<float>(motion.feet[foot][axis]);
      message->foot_speed_body[slot] = static_cast<float>(motion.feet_speed[foot][axis]);
    }
  }
}

}  // namespace

MotionFields MotionFieldsOf(const robot::RobotSpec& spec) {
  if (spec.family != robot::WireFamily::kGo || !robot::IsQuadruped(spec.kind)) {
    return MotionFields::kNone;
  }
  return robot::TellsStateId(spec) ? MotionFields::kStateId : MotionFields::kMode;
}

void EncodeMotion(const robot::RobotState& state, const robot::RobotSpec& spec, MotionFields fields,
                  unitree_go_msg_dds__SportModeState_* message) {
  message->stamp.sec = static_cast<std::int32_t>(state.tick_ms / 1000);
  message->stamp.nanosec = static_cast<std::uint32_t>(state.tick_ms % 1000) * 1'000'000;
  EncodeImu(state.imu, &message->imu_state);
  Eigen::Vector3d position = state.odometry.p_WB, velocity = state.odometry.v_WB_W;
  if (state.motion && state.motion->estimates) {
    position << state.motion->p_WB.head<2>(), state.motion->body_height;
    velocity = state.motion->v_WB_W;
  }
  for (int i = 0; i < 3; ++i) {
    message->position[i] = static_cast<float>(position[i]);
    message->velocity[i] = static_cast<float>(velocity[i]);
  }
  message->body_height = message->position[2];
  message->yaw_speed = message->imu_state.gyroscope[2];

  if (spec.family == robot::WireFamily::kHg) {
    message->stamp = {};
    message->body_height = 0;
  }
  if (fields == MotionFields::kStateId) {
    message->error_code = state.motion ? static_cast<std::uint32_t>(state.motion->id) : kDampedId;
    message->body_height += kHeightOverPosition;
  } else if (fields == MotionFields::kMode) {
    message->mode = state.motion ? static_cast<std::uint8_t>(state.motion->mode) : kDampedMode;
    message->progress = state.motion ? static_cast<float>(state.motion->progress) : 0;
    message->gait_type = kGait;
    message->foot_raise_height = kFootRaise;
    message->body_height = kBodyHeight;
    for (std::size_t side = 0; side < state.obstacle_ranges.size(); ++side) {
      message->range_obstacle[side] = static_cast<float>(state.obstacle_ranges[side]);
    }
    if (state.motion && state.motion->estimates) EncodeGait(*state.motion, message);
    const std::size_t feet = std::min(state.foot_force.size(), std::size(message->foot_force));
    for (std::size_t i = 0; i < feet; ++i) {
      message->foot_force[i] = FootCounts(state.foot_force[i], spec.foot_sensor);
    }
  }
}

void EncodeFsm(const robot::RobotState& state, unitree_hg_msg_dds__SportModeState_* message) {
  message->fsm_id = static_cast<std::uint32_t>(state.motion->id);
  message->fsm_mode = static_cast<std::uint32_t>(state.motion->mode);
  message->task_id = kIdleTask;
}

std::array<char, 96> ArmActionText(const robot::MotionState& motion) {
  const auto* action =
      std::ranges::find(robot::kArmActions, motion.arm_told, &robot::ArmActionName::id);
  std::array<char, 96> text{};
  std::snprintf(text.data(), text.size(), R"({"holding": %s, "id": %d, "name": "%s"})",
                motion.arm_holding ? "true" : "false", motion.arm_told,
                action == robot::kArmActions.end() ? "" : action->name.data());
  return text;
}

}  // namespace understudy::wire
