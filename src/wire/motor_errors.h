// The words with which messages tell what is wrong with a motor.
#pragma once

#include <cstdint>

#include "robot/robot_values.h"

namespace understudy::wire {

// The bits of a family's word (docs/dev/sources.md#developer-pages).
struct MotorErrorBits {
  std::uint32_t undervoltage, winding_warm, winding_hot, encoder, silent;
};

// MotorState_.reserve[0]: vendor, Go2 fault services.
inline constexpr MotorErrorBits kGoMotorErrors{
    .undervoltage = 0x08, .winding_warm = 0, .winding_hot = 0x10, .encoder = 0x20, .silent = 0x100};
// MotorState_.motorstate: vendor, G1 common mistakes and definitions; winding_warm by a public copy
// of the dictionary of the vendor's app.
inline constexpr MotorErrorBits kHgMotorErrors{.undervoltage = 0x8,
                                               .winding_warm = 0x10000000,
                                               .winding_hot = 0x200,
                                               .encoder = 0x400,
                                               .silent = 0x80000000};

inline std::uint32_t ErrorsOf(const robot::MotorReading& motor, const MotorErrorBits& bits) {
  return (motor.undervoltage ? bits.undervoltage : 0) | (motor.warm ? bits.winding_warm : 0) |
         (motor.overheated ? bits.winding_hot : 0) | (motor.encoder_error ? bits.encoder : 0) |
         (motor.silent ? bits.silent : 0);
}

}  // namespace understudy::wire
