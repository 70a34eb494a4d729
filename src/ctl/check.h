// Validators for the command line of `understudy ctl`.
#pragma once

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace understudy::ctl {

// Accepts a finite number from `low` to `high`.
CLI::Validator NumberWithin(double low, double high);

// Accepts one of `words`; the error names the nearest.
CLI::Validator OneOf(std::vector<std::string> words);

}  // namespace understudy::ctl
