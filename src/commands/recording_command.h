// Runs `understudy recording`: lists what a recording holds.
#ifndef UNDERSTUDY_COMMANDS_RECORDING_COMMAND_H_
#define UNDERSTUDY_COMMANDS_RECORDING_COMMAND_H_

#include <string>

namespace understudy::commands {

// Prints it; returns the exit code. Throws RecordError.
int RecordingCommand(const std::string& file, bool json);

}  // namespace understudy::commands

#endif  // UNDERSTUDY_COMMANDS_RECORDING_COMMAND_H_
