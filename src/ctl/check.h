// Validators for the command line of `understudy ctl`.
#pragma once

#include <CLI/CLI.hpp>

namespace understudy::ctl {

// Accepts a finite number from `low` to `high`.
CLI::Validator NumberWithin(double low, double high);

}  // namespace understudy::ctl
