#include "sensors/encoders.h"

#include <numbers>
#include <utility>

namespace understudy::sensors {

Encoders::Encoders(std::vector<double> zeros, int seed)
    : zeros_(std::move(zeros)),
      q_(zeros_.size()),
      dq_(zeros_.size()),
      random_(static_cast<std::uint64_t>(seed) + 0xE2C0DE) {}

void Encoders::Step(std::span<const double> q, std::span<const double> dq,
                    std::span<const robot::EncoderEffects> faults) {
  // From [-1, 1): the same with every standard library, which a distribution is not.
  const auto uniform = [this] { return static_cast<double>(random_() >> 11U) * 0x1p-52 - 1; };
  for (std::size_t i = 0; i < q_.size(); ++i) {
    const robot::EncoderEffects& fault = faults[i];
    if (fault.stuck) {
      dq_[i] = 0;
      continue;
    }
    q_[i] = fault.dead ? 0 : q[i] + zeros_[i] + fault.offset;
    dq_[i] = fault.dead ? 0 : dq[i];
    // The sum of three of them has the standard deviation 1.
    if (fault.noise > 0) q_[i] += fault.noise * (uniform() + uniform() + uniform());
    if (fault.garbage) q_[i] = 2 * std::numbers::pi * uniform();
  }
}

}  // namespace understudy::sensors
