// Checks of what `understudy ctl` is given on its command line.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace understudy::ctl {

// A finite number from `low` to `high`.
CLI::Validator NumberWithin(double low, double high);

// One of `words`; the nearest is named where it is none.
CLI::Validator OneOf(std::vector<std::string> words);

}  // namespace understudy::ctl
