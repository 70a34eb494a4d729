#include "tests/emulator/state_bytes.h"

#include <type_traits>

namespace understudy::emulator {
namespace {

template <class... Numbers>
void Append(std::string* bytes, const Numbers&... numbers) {
  static_assert((std::has_unique_object_representations_v<Numbers> && ...) ||
                (std::is_floating_point_v<Numbers> && ...));
  (bytes->append(reinterpret_cast<const char*>(&numbers), sizeof(numbers)), ...);
}

void Append(std::string* bytes, const robot::ImuReading& imu) {
  Append(bytes, imu.R_WI.w(), imu.R_WI.x(), imu.R_WI.y(), imu.R_WI.z(), imu.temperature_c);
  for (int i = 0; i < 3; ++i) Append(bytes, imu.w_WI_I[i], imu.f_WI_I[i]);
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
  for (const double force : state.foot_force) Append(&bytes, force);
  Append(&bytes, state.battery.voltage, state.battery.current, state.battery.soc,
         state.battery.temperature_c);
  for (int i = 0; i < 3; ++i) Append(&bytes, state.base.p_WB[i], state.base.v_WB_W[i]);
  Append(&bytes, state.remote.there, state.remote.keys);
  Append(&bytes, state.remote.lx, state.remote.ly, state.remote.rx, state.remote.ry);
  if (state.motion) Append(&bytes, state.motion->id, state.motion->mode, state.motion->progress);
  return bytes;
}

}  // namespace understudy::emulator
