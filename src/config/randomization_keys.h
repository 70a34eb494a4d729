// The ranges of randomization, one row per quantity: read, printed, documented and checked from it.
#ifndef UNDERSTUDY_CONFIG_RANDOMIZATION_KEYS_H_
#define UNDERSTUDY_CONFIG_RANDOMIZATION_KEYS_H_

#include <span>

#include "config/archive.h"
#include "config/keys.h"
#include "robot/randomization.h"

namespace understudy {

struct RandomRange {
  Row row;
  RandomizationSpec::Limits RandomizationSpec::*limits;
};

std::span<const RandomRange> RandomRanges();

// Whether anything is to be drawn.
bool IsRandom(const RandomizationSpec& spec);

void DescribeRandomization(Archive& a, RandomizationSpec& r);

}  // namespace understudy

#endif  // UNDERSTUDY_CONFIG_RANDOMIZATION_KEYS_H_
