// The words with which messages tell what is wrong with a motor.
#pragma once

#include <cstdint>

#include "robot/robot_values.h"

namespace understudy::wire {

// The bits of a family's word (docs/sources.md#developer-pages).
struct MotorErrorBits {
  std::uint32_t winding_hot, encoder, silent;
};

// MotorState_.reserve[0]: vendor, Go2 fault services.
inline constexpr MotorErrorBits kGoMotorErrors{
    .winding_hot = 0x10, .encoder = 0x20, .silent = 0x100};
// MotorState_.motorstate: vendor, G1 common mistakes and definitions.
inline constexpr MotorErrorBits kHgMotorErrors{
    .winding_hot = 0x200, .encoder = 0x400, .silent = 0x80000000};

inline std::uint32_t ErrorsOf(const robot::MotorReading& motor, const MotorErrorBits& bits) {
  return (motor.overheated ? bits.winding_hot : 0) | (motor.encoder_error ? bits.encoder : 0) |
         (motor.silent ? bits.silent : 0);
}

}  // namespace understudy::wire
