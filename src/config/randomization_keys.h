// Lists the ranges of randomization, one row per quantity. They are read, printed, documented and
// checked by these rows.
#pragma once

#include <span>
#include <string_view>

#include "config/keys.h"
#include "robot/randomization.h"
#include "schema/archive.h"

namespace understudy::config {

struct RandomRange {
  std::string_view name;  // the key
  robot::RandomizationSpec::Limits robot::RandomizationSpec::*limits;
  About about;
};

std::span<const RandomRange> RandomRanges();

// Returns whether anything is drawn at random.
bool IsRandom(const robot::RandomizationSpec& spec);

void DescribeRandomization(Archive& a, robot::RandomizationSpec& r);

}  // namespace understudy::config
