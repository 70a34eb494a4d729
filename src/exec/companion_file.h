// Finds the companion programs, which link libraries that the daemon does not.
#pragma once

#include <filesystem>
#include <string>

namespace understudy::exec {

// Returns the path of a companion of this program, in libexec/understudy beside bin; it may not
// exist.
std::filesystem::path CompanionFile(const std::string& program);

}  // namespace understudy::exec
