// The ranges of randomization, one row per quantity: read, printed, documented and checked from it.
#pragma once

#include <span>
#include <string_view>

#include "config/archive.h"
#include "config/keys.h"
#include "robot/randomization.h"

namespace understudy::config {

struct RandomRange {
  std::string_view name;  // of its key
  robot::RandomizationSpec::Limits robot::RandomizationSpec::*limits;
  About about;
};

std::span<const RandomRange> RandomRanges();

// Whether anything is to be drawn.
bool IsRandom(const robot::RandomizationSpec& spec);

void DescribeRandomization(Archive& a, robot::RandomizationSpec& r);

}  // namespace understudy::config
