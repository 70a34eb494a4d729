#include "wire/imu_codec.h"

#include <algorithm>
#include <cmath>

#include "wire/rounded.h"

namespace understudy::wire {
namespace {

template <typename Message>
void Encode(const robot::ImuReading& reading, Message* message) {
  Eigen::Quaterniond R_WI = reading.R_WI;
  const double norm = R_WI.norm();
  if (norm > 0 && std::isfinite(norm)) {
    R_WI.coeffs() /= norm;
  } else {
    R_WI = Eigen::Quaterniond::Identity();
  }

  float* wire = message->quaternion;
  const double agreement =
      R_WI.w() * wire[0] + R_WI.x() * wire[1] + R_WI.y() * wire[2] + R_WI.z() * wire[3];
  if (agreement < 0 || (agreement == 0 && R_WI.w() < 0)) R_WI.coeffs() *= -1;
  wire[0] = static_cast<float>(R_WI.w());
  wire[1] = static_cast<float>(R_WI.x());
  wire[2] = static_cast<float>(R_WI.y());
  wire[3] = static_cast<float>(R_WI.z());

  const Eigen::Vector3d rpy = RollPitchYaw(R_WI);
  for (int i = 0; i < 3; ++i) {
    message->gyroscope[i] = static_cast<float>(reading.w_WI_I[i]);
    message->accelerometer[i] = static_cast<float>(reading.f_WI_I[i]);
    message->rpy[i] = static_cast<float>(rpy[i]);
  }
}

}  // namespace

void EncodeImu(const robot::ImuReading& reading, unitree_go_msg_dds__IMUState_* message) {
  Encode(reading, message);
  message->temperature = Rounded<std::uint8_t>(reading.temperature_c, 0, 127);
}

void EncodeImu(const robot::ImuReading& reading, unitree_hg_msg_dds__IMUState_* message) {
  Encode(reading, message);
  message->temperature = Rounded<std::int16_t>(reading.temperature_c);
}

}  // namespace understudy::wire
