#include "wire/hand_codec.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <span>

#include "robot/hand_law.h"
#include "wire/motor_errors.h"
#include "wire/rounded.h"
#include "wire/slots.h"

namespace understudy::wire {
namespace {

constexpr int kStatusShift = 4;
constexpr int kTimeoutShift = 7;
constexpr unsigned kIdMask = kHandIds - 1;
constexpr unsigned kStatusMask = 7;

constexpr unsigned kLocked = 0;
constexpr unsigned kFollowing = 1;

double Length(const robot::MotorSpec& motor) { return motor.span[1] - motor.span[0]; }

float Share(double value, double whole) {
  constexpr double kSteps = 1000;  // on the serial lines of hands
  return static_cast<float>(std::round(kSteps * value / whole) / kSteps);
}

}  // namespace

robot::Refusal Decode(const unitree_hg_msg_dds__HandCmd_& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command) {
  const std::span wire(message.motor_cmd._buffer, message.motor_cmd._length);
  if (wire.size() != spec.motors.size()) return robot::Refusal::kMotorCount;
  command->motors.resize(wire.size());
  bool modes_known = true;
  for (std::size_t i = 0; i < wire.size(); ++i) {
    const unsigned mode = wire[i].mode;
    const unsigned status = mode >> kStatusShift & kStatusMask;
    modes_known = modes_known && (mode & kIdMask) == i && status <= kFollowing;
    command->motors[i] = DecodeMotor(wire[i]);
    command->motors[i].enabled = status != kLocked;
    command->motors[i].watched = mode >> kTimeoutShift != 0;
  }
  return modes_known ? robot::Refusal::kNone : robot::Refusal::kMotorMode;
}

HandStateMessage::HandStateMessage(const robot::HandSpec& spec)
    : motors_(spec.motors.size()), pads_(spec.pads.size()) {
  std::size_t first = 0;
  for (std::size_t i = 0; i < pads_.size(); ++i) {
    std::ranges::fill(pads_[i].pressure, kNoTaxel);
    for (const double taxel : spec.pads[i].taxels) {
      const auto t = static_cast<std::size_t>(taxel);
      std::span(pads_[i].pressure)[t] = kUntouched;
      std::span(pads_[i].temperature)[t] = static_cast<float>(spec.temperature_c);
      taxels_.push_back({.pad = i, .place = t, .cell = first + t});
    }
    first += robot::CellsOf(spec.pads[i]);
  }
  message_.power_v = static_cast<float>(spec.supply_v);
}

void HandStateMessage::Encode(std::span<const robot::MotorReading> reading) {
  for (std::size_t i = 0; i < motors_.size(); ++i) {
    const robot::MotorReading& motor = reading[i];
    unitree_hg_msg_dds__MotorState_& wire = motors_[i];
    const unsigned status = motor.enabled ? kFollowing : kLocked;
    const unsigned timed_out = motor.timed_out ? 1U << kTimeoutShift : 0;
    wire.mode = static_cast<std::uint8_t>(i | status << kStatusShift | timed_out);
    wire.q = static_cast<float>(motor.q);
    wire.dq = static_cast<float>(motor.dq);
    wire.tau_est = static_cast<float>(motor.tau);
    wire.temperature[0] = Rounded<std::int16_t>(motor.casing_c);
    wire.temperature[1] = Rounded<std::int16_t>(motor.winding_c);
    wire.motorstate = ErrorsOf(motor, kHgMotorErrors);
  }
}

void HandStateMessage::EncodeTouch(std::span<const float> counts) {
  for (const Taxel& taxel : taxels_) {
    if (taxel.cell >= counts.size()) break;
    std::span(pads_[taxel.pad].pressure)[taxel.place] = kUntouched + counts[taxel.cell];
  }
}

unitree_hg_msg_dds__HandState_ HandStateMessage::message() {
  message_.motor_state = {._maximum = static_cast<std::uint32_t>(motors_.size()),
                          ._length = static_cast<std::uint32_t>(motors_.size()),
                          ._buffer = motors_.data(),
                          ._release = false};
  message_.press_sensor_state = {._maximum = static_cast<std::uint32_t>(pads_.size()),
                                 ._length = static_cast<std::uint32_t>(pads_.size()),
                                 ._buffer = pads_.data(),
                                 ._release = false};
  return message_;
}

robot::Refusal Decode(const unitree_go_msg_dds__MotorCmds_& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command) {
  const std::span wire(message.cmds._buffer, message.cmds._length);
  if (wire.size() < robot::SlotsOf(spec)) return robot::Refusal::kMotorCount;
  command->motors.resize(spec.motors.size());
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec.motors[i];
    robot::MotorCommand& decoded = command->motors[i];
    decoded = DecodeMotor(wire[static_cast<std::size_t>(spec.slot) + i]);
    decoded.enabled = true;
    decoded.watched = robot::LawOf(spec).watched;
    if (Length(motor) == 0) continue;
    decoded.q = motor.span[0] + std::clamp(decoded.q, 0.0, 1.0) * Length(motor);
    decoded.dq = std::clamp(decoded.dq, 0.0, 1.0) * motor.knee_speed;
  }
  return robot::Refusal::kNone;
}

robot::Refusal DecodeHandSdk(const unitree_go_msg_dds__MotorCmds_& message,
                             const robot::RobotSpec& spec, robot::RobotCommand* command) {
  const std::span wire(message.cmds._buffer, message.cmds._length);
  if (wire.size() < robot::kHandSdkMotors) return robot::Refusal::kMotorCount;
  command->weight = wire[0].mode / 100.0;
  command->motors.clear();
  for (const robot::HandSpec& hand : spec.hands) {
    for (std::size_t i = 0; i < hand.motors.size(); ++i) {
      robot::MotorCommand& decoded = command->motors.emplace_back();
      if (hand.sdk_slot < 0) continue;
      decoded = DecodeMotor(wire[static_cast<std::size_t>(hand.sdk_slot) + i]);
      decoded.enabled = true;
      if (decoded.q != robot::kNoPosition) decoded.q = -decoded.q;
      if (decoded.dq != robot::kNoVelocity) decoded.dq = -decoded.dq;
      decoded.tau = -decoded.tau;
    }
  }
  return robot::Refusal::kNone;
}

MotorStatesMessage::MotorStatesMessage(const robot::HandSpec& spec)
    : spec_(spec), motors_(robot::SlotsOf(spec)) {}

void MotorStatesMessage::Encode(std::span<const robot::MotorReading> reading) {
  const robot::HandLaw& law = robot::LawOf(spec_);
  for (std::size_t i = 0; i < spec_.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec_.motors[i];
    const robot::MotorReading& read = reading[i];
    unitree_go_msg_dds__MotorState_& wire = motors_[static_cast<std::size_t>(spec_.slot) + i];
    const double length = Length(motor);
    const double way = std::copysign(1.0, length);
    const bool shares = length != 0;
    wire.q = shares ? Share(read.q - motor.span[0], length) : static_cast<float>(read.q);
    if (law.shows_motion) {
      wire.dq = shares ? Share(way * read.dq, motor.knee_speed) : static_cast<float>(read.dq);
      wire.tau_est =
          shares ? Share(way * read.tau, motor.torque_limit) : static_cast<float>(read.tau);
    }
    if (law.counts_lost) wire.lost = read.lost;
  }
}

unitree_go_msg_dds__MotorStates_ MotorStatesMessage::message() {
  return {.states = {._maximum = static_cast<std::uint32_t>(motors_.size()),
                     ._length = static_cast<std::uint32_t>(motors_.size()),
                     ._buffer = motors_.data(),
                     ._release = false}};
}

}  // namespace understudy::wire
