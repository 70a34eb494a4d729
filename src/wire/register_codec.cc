#include "wire/register_codec.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "base/errors.h"
#include "robot/hand_law.h"
#include "wire/rounded.h"

namespace understudy::wire {
namespace {

constexpr int kAngles = 1000, kPositions = 2000, kSpeeds = 1000, kGrams = 3000;
constexpr int kMostGrams = 4000, kMostMilliampere = 2000;  // that states tell
enum ModeBit : unsigned { kAngle = 1, kPosition = 2, kForce = 4, kSpeed = 8 };

double SpanLength(const robot::MotorSpec& motor) { return motor.span[1] - motor.span[0]; }

constexpr std::array<std::size_t, TouchMessage::kFields> kLengths = {
    9, 96, 80, 9, 96, 80, 9, 96, 80, 9, 96, 80, 9, 96, 9, 96, 112};
using Touch = inspire_inspire_hand_touch;
constexpr std::array<dds_sequence_int16 Touch::*, TouchMessage::kFields> kTouchFields = {
    &Touch::fingerone_tip_touch,
    &Touch::fingerone_top_touch,
    &Touch::fingerone_palm_touch,
    &Touch::fingertwo_tip_touch,
    &Touch::fingertwo_top_touch,
    &Touch::fingertwo_palm_touch,
    &Touch::fingerthree_tip_touch,
    &Touch::fingerthree_top_touch,
    &Touch::fingerthree_palm_touch,
    &Touch::fingerfour_tip_touch,
    &Touch::fingerfour_top_touch,
    &Touch::fingerfour_palm_touch,
    &Touch::fingerfive_tip_touch,
    &Touch::fingerfive_top_touch,
    &Touch::fingerfive_middle_touch,
    &Touch::fingerfive_palm_touch,
    &Touch::palm_touch};

// What a command asks of a motor before it asks for anything.
constexpr robot::MotorCommand kAsksNothing{
    .enabled = true, .q = robot::kNoPosition, .dq = robot::kNoVelocity, .tau = -1};

// A register of a command: what its values are worth, 0 to `most`.
struct Register {
  unsigned bit;
  dds_sequence_int16 inspire_inspire_hand_ctrl::*values;
  int most;
  void (*put)(double share, const robot::MotorSpec& motor, robot::MotorCommand* command);
};

// In the order in which the driver writes them.
constexpr Register kRegisters[] = {
    {kAngle, &inspire_inspire_hand_ctrl::angle_set, kAngles,
     [](double share, const robot::MotorSpec& motor, robot::MotorCommand* command) {
       command->q = motor.span[0] + share * SpanLength(motor);
     }},
    {kPosition, &inspire_inspire_hand_ctrl::pos_set, kPositions,
     [](double share, const robot::MotorSpec& motor, robot::MotorCommand* command) {
       command->q = motor.span[1] - share * SpanLength(motor);
     }},
    {kForce, &inspire_inspire_hand_ctrl::force_set, kGrams,
     [](double share, const robot::MotorSpec& motor, robot::MotorCommand* command) {
       command->tau = share * motor.torque_limit;
     }},
    {kSpeed, &inspire_inspire_hand_ctrl::speed_set, kSpeeds,
     [](double share, const robot::MotorSpec& motor, robot::MotorCommand* command) {
       command->dq = share * motor.knee_speed;
     }},
};

constexpr unsigned Bit(bool on, RegisterStateMessage::Error bit) {
  return on ? static_cast<unsigned>(bit) : 0U;
}

// A sequence of the generated type with these values, which it does not own.
template <typename Sequence, typename Value>
void Point(Sequence* sequence, std::span<Value> values) {
  sequence->_maximum = sequence->_length = static_cast<std::uint32_t>(values.size());
  sequence->_buffer = values.data();
  sequence->_release = false;
}

}  // namespace

robot::Refusal Decode(const inspire_inspire_hand_ctrl& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command) {
  const unsigned mode = static_cast<std::uint8_t>(message.mode);
  for (const Register& one : kRegisters) {
    if ((mode & one.bit) != 0 && (message.*one.values)._length != spec.motors.size()) {
      return robot::Refusal::kMotorCount;
    }
  }
  command->motors.assign(spec.motors.size(), kAsksNothing);
  for (const Register& one : kRegisters) {
    if ((mode & one.bit) == 0) continue;
    const dds_sequence_int16& values = message.*one.values;
    for (std::size_t i = 0; i < spec.motors.size(); ++i) {
      const std::int16_t value = values._buffer[i];
      if (value < 0) continue;
      one.put(std::min(static_cast<double>(value) / one.most, 1.0), spec.motors[i],
              &command->motors[i]);
    }
  }
  return robot::Refusal::kNone;
}

RegisterStateMessage::RegisterStateMessage(const robot::HandSpec& spec)
    : spec_(spec),
      pos_(spec.motors.size()),
      angle_(pos_),
      force_(pos_),
      current_(pos_),
      err_(spec.motors.size()),
      status_(err_),
      temperature_(err_) {}

RegisterStateMessage::Status RegisterStateMessage::StatusOf(const robot::MotorSpec& motor,
                                                            const robot::MotorReading& read) const {
  constexpr double kAtLimit = 0.95, kSlow = 0.05;  // shares, *assumed*
  if (read.overheated || read.silent) return kFailed;
  if (!read.enabled) return kReached;
  const double most = std::min(read.most, motor.torque_limit);
  const bool pushes = std::abs(read.tau) >= kAtLimit * most;
  const bool rests = std::abs(read.dq) < kSlow * motor.knee_speed;
  if (pushes && rests) return read.tau * SpanLength(motor) > 0 ? kStalled : kForce;
  const bool all = std::abs(read.tau) >= kAtLimit * motor.torque_limit;
  if (all && !rests && read.tau * read.dq < 0) return kCurrent;
  if (read.led_dq == 0) return kReached;
  return read.led_dq * SpanLength(motor) > 0 ? kOpens : kCloses;
}

void RegisterStateMessage::Encode(std::span<const robot::MotorReading> reading) {
  for (std::size_t i = 0; i < spec_.motors.size(); ++i) {
    const robot::MotorSpec& motor = spec_.motors[i];
    const robot::MotorReading& read = reading[i];
    const double open = (read.q - motor.span[0]) / SpanLength(motor);
    const double closing = read.tau / std::copysign(motor.torque_limit, -SpanLength(motor));
    angle_[i] = Rounded<std::int16_t>(kAngles * open, 0, kAngles);
    pos_[i] = Rounded<std::int16_t>(kPositions * (1 - open), 0, kPositions);
    force_[i] = Rounded<std::int16_t>(kGrams * closing, -kMostGrams, kMostGrams);
    current_[i] = Rounded<std::int16_t>(kGripCurrent * std::abs(closing), 0, kMostMilliampere);
    temperature_[i] = Rounded<std::uint8_t>(read.casing_c, 0, 100);
    status_[i] = StatusOf(motor, read);
    err_[i] = static_cast<std::uint8_t>(
        Bit(status_[i] == kStalled, kStallError) | Bit(read.overheated, kHeatError) |
        Bit(status_[i] == kCurrent, kCurrentError) | Bit(read.encoder_error, kMotorError) |
        Bit(read.silent, kLinkError));
  }
}

inspire_inspire_hand_state RegisterStateMessage::message() {
  inspire_inspire_hand_state message{};
  Point(&message.pos_act, std::span(pos_));
  Point(&message.angle_act, std::span(angle_));
  Point(&message.force_act, std::span(force_));
  Point(&message.current, std::span(current_));
  Point(&message.err, std::span(err_));
  Point(&message.status, std::span(status_));
  Point(&message.temperature, std::span(temperature_));
  return message;
}

std::span<const std::size_t, TouchMessage::kFields> TouchMessage::Lengths() { return kLengths; }

TouchMessage::TouchMessage(const robot::HandSpec& spec) : cells_(robot::CellsOf(spec)) {
  bool fits = spec.pads.size() == kFields;
  for (std::size_t i = 0; fits && i < kFields; ++i) {
    fits = robot::CellsOf(spec.pads[i]) == kLengths[i];
  }
  if (!fits) {
    throw ModelError("hand " + spec.name + ": expected " + std::to_string(kFields) +
                     " pads with as many cells as the fields of inspire_hand_touch have");
  }
}

void TouchMessage::Encode(std::span<const float> counts) {
  for (std::size_t i = 0; i < std::min(cells_.size(), counts.size()); ++i)
    cells_[i] = Rounded<std::int16_t>(counts[i], 0);
}

inspire_inspire_hand_touch TouchMessage::message() {
  inspire_inspire_hand_touch message{};
  std::span<std::int16_t> rest(cells_);
  for (std::size_t i = 0; i < kFields; ++i) {
    Point(&(message.*kTouchFields[i]), rest.first(kLengths[i]));
    rest = rest.subspan(kLengths[i]);
  }
  return message;
}

}  // namespace understudy::wire
