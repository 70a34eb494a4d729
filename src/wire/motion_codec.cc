#include "wire/motion_codec.h"

#include <cstdint>

#include "wire/imu_codec.h"

namespace understudy {
namespace {

// Vendor, Go2 motion services V2.0; on other robots assumed.
constexpr std::uint32_t kDamping = 1001;

}  // namespace

void EncodeMotion(const RobotState& state, unitree_go_msg_dds__SportModeState_* message) {
  message->stamp.sec = static_cast<std::int32_t>(state.tick_ms / 1000);
  message->stamp.nanosec = static_cast<std::uint32_t>(state.tick_ms % 1000) * 1'000'000;
  message->error_code = kDamping;
  EncodeImu(state.imu, &message->imu_state);
  for (int i = 0; i < 3; ++i) {
    message->position[i] = static_cast<float>(state.base.p_WB[i]);
    message->velocity[i] = static_cast<float>(state.base.v_WB_W[i]);
  }
  message->body_height = message->position[2];
  message->yaw_speed = message->imu_state.gyroscope[2];
}

}  // namespace understudy
