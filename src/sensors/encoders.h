// What the encoders of a robot's motors read, errors of their zeros and faults included.
#pragma once

#include <cstdint>
#include <random>
#include <span>
#include <vector>

#include "robot/fault.h"

namespace understudy::sensors {

// The joint angles and rates that drives and messages live on. Allocates only in the constructor.
class Encoders {
 public:
  // `zeros` [rad] is what each reads where there is no angle, in motor order. Equal seeds give
  // equal noise.
  Encoders(std::vector<double> zeros, int seed);

  // Reads the joints at angles q [rad] and rates dq [rad/s], in motor order like `faults`.
  void Step(std::span<const double> q, std::span<const double> dq,
            std::span<const robot::EncoderEffects> faults);

  // As of the last Step, zeros before.
  std::span<const double> q() const { return q_; }
  std::span<const double> dq() const { return dq_; }

 private:
  std::vector<double> zeros_, q_, dq_;
  std::mt19937_64 random_;
};

}  // namespace understudy::sensors
