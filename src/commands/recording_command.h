// Runs `understudy recording`: lists what a recording holds.
#pragma once

#include <string>

namespace understudy::commands {

// Prints it; returns the exit code. Throws RecordError.
int RecordingCommand(const std::string& file, bool json);

}  // namespace understudy::commands
