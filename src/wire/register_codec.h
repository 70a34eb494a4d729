// Encodes and decodes the messages of hands that have registers, as Inspire's FTP hands have:
// inspire_hand_ctrl, inspire_hand_state and inspire_hand_touch. Figures are those of the hand's
// manual (docs/hands.md).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "idl/inspire.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::wire {

// Decodes the registers that the bits of `mode` select: 1 angle, 2 position, 4 force, 8 speed; of
// angle and position the driver writes the position last, which then holds. Values are cut to their
// ranges: angles 0 to 1000 of the span, positions 0 to 2000 from its other end, forces 0 to 3000 g
// of torque_limit, speeds 0 to 1000 of knee_speed. A value below 0 leaves the register as it is,
// which the manual says of -1 and of angles and positions alone. What a command does not set is
// kNoPosition, kNoVelocity and a torque below 0. Returns kMotorCount if a selected register has not
// one value for each motor; `command` does not change then.
robot::Refusal Decode(const inspire_inspire_hand_ctrl& message, const robot::HandSpec& spec,
                      robot::RobotCommand* command);

// An inspire_hand_state and the memory of its sequences.
class RegisterStateMessage {
 public:
  // `spec` must outlive this object.
  explicit RegisterStateMessage(const robot::HandSpec& spec);

  // Encodes the readings of its motors, in their order; ignores further ones. Force [g] is the
  // share of torque_limit, positive where it closes; current the same share of kGripCurrent:
  // *assumed*. A motor at rest that has had no command has the status kReached: *assumed*.
  void Encode(std::span<const robot::MotorReading> reading);

  // Returns the message, whose sequences are of this object and valid as long as it is.
  inspire_inspire_hand_state message();

  enum Status : std::uint8_t {
    kOpens = 0,
    kCloses = 1,
    kReached = 2,
    kForce = 3,    // it closes with as much as its register of force has
    kCurrent = 5,  // its current is at its limit, and it is moved the other way: *assumed*
    kStalled = 6,  // it opens with as much and does not move
    kFailed = 7,   // too hot, or not answering
  };
  // Bits of err.
  enum Error : std::uint8_t {
    kStallError = 1,
    kHeatError = 2,
    kCurrentError = 4,
    kMotorError = 8,
    kLinkError = 16,
  };

  static constexpr double kGripCurrent = 750;  // mA, a sixth of what a hand draws at its most

 private:
  Status StatusOf(const robot::MotorSpec& motor, const robot::MotorReading& read) const;

  const robot::HandSpec& spec_;
  std::vector<std::int16_t> pos_, angle_, force_, current_;
  std::vector<std::uint8_t> err_, status_, temperature_;
};

// An inspire_hand_touch and the memory of its sequences.
class TouchMessage {
 public:
  static constexpr std::size_t kFields = 17;
  // Returns how many cells each field has.
  static std::span<const std::size_t, kFields> Lengths();

  // The pads of `spec` are the fields: throws ModelError if they have other cells.
  explicit TouchMessage(const robot::HandSpec& spec);

  // Encodes what the cells show, in their order; ignores further ones.
  void Encode(std::span<const float> counts);

  // Returns the message, whose sequences are of this object and valid as long as it is.
  inspire_inspire_hand_touch message();

 private:
  std::vector<std::int16_t> cells_;
};

}  // namespace understudy::wire
