#include "tests/emulator/state_bytes.h"

#include <type_traits>
#include <vector>

namespace understudy::emulator {
namespace {

template <class... Numbers>
void Append(std::string* bytes, const Numbers&... numbers) {
  static_assert((std::has_unique_object_representations_v<Numbers> && ...) ||
                (std::is_floating_point_v<Numbers> && ...));
  (bytes->append(reinterpret_cast<const char*>(&numbers), sizeof(numbers)), ...);
}

template <class Number>
void Append(std::string* bytes, const std::vector<Number>& numbers) {
  for (const Number number : numbers) Append(bytes, number);
}

void Append(std::string* bytes, const Eigen::Vector3d& vector) {
  for (int i = 0; i < 3; ++i) Append(bytes, vector[i]);
}

void Append(std::string* bytes, const Eigen::Quaterniond& q) {
  Append(bytes, q.w(), q.x(), q.y(), q.z());
}

void Append(std::string* bytes, const robot::ImuReading& imu) {
  Append(bytes, imu.R_WI);
  Append(bytes, imu.temperature_c);
  Append(bytes, imu.w_WI_I);
  Append(bytes, imu.f_WI_I);
}

void Append(std::string* bytes, const robot::BaseReading& base) {
  Append(bytes, base.p_WB);
  Append(bytes, base.v_WB_W);
}

}  // namespace

std::string Bytes(const robot::RobotState& state) {
  std::string bytes;
  Append(&bytes, state.tick_ms);
  for (const robot::MotorReading& motor : state.motors) {
    Append(&bytes, motor.enabled, motor.timed_out);
    Append(&bytes, motor.q, motor.dq, motor.tau, motor.casing_c, motor.winding_c);
  }
  Append(&bytes, state.joint_space);
  Append(&bytes, state.imu);
  Append(&bytes, state.secondary_imu);
  Append(&bytes, state.foot_force);
  Append(&bytes, state.touch);
  Append(&bytes, state.battery.voltage, state.battery.current, state.battery.soc,
         state.battery.temperature_c);
  Append(&bytes, state.board.centre_c, state.board.charger_c);
  Append(&bytes, state.board.stalled, state.board.mute);
  for (const double rpm : state.board.fan_rpm) Append(&bytes, rpm);
  Append(&bytes, state.base);
  Append(&bytes, state.odometry);
  if (state.leg_odometry) {
    Append(&bytes, state.leg_odometry->R_OB);
    Append(&bytes, state.leg_odometry->p_OB);
    Append(&bytes, state.leg_odometry->v_OB_B);
  }
  Append(&bytes, state.truth.q);
  Append(&bytes, state.truth.dq);
  Append(&bytes, state.truth.tau);
  Append(&bytes, state.truth.imu);
  Append(&bytes, state.truth.secondary_imu);
  Append(&bytes, state.truth.foot_force);
  for (const double range : state.obstacle_ranges) Append(&bytes, range);
  Append(&bytes, state.remote.there, state.remote.keys);
  Append(&bytes, state.remote.lx, state.remote.ly, state.remote.rx, state.remote.ry);
  if (state.motion) Append(&bytes, state.motion->id, state.motion->mode, state.motion->progress);
  return bytes;
}

}  // namespace understudy::emulator
