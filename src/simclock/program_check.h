// Whether a program can take the simulated clock.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace understudy::simclock {

// Returns why the file cannot, as in "/bin/x is linked statically", or "" if nothing speaks against
// it: the library reaches programs of 64 bits that the loader of libc starts. Follows the `#!`
// lines of scripts. `search_path` is that of their `env`.
std::string WhyNoClock(const std::filesystem::path& program, const std::string& search_path);

}  // namespace understudy::simclock
