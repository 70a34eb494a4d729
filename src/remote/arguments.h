// What `understudy remote` is told. Knows no SDL: the daemon's program parses these too, for --help
// and completions.
#ifndef UNDERSTUDY_REMOTE_ARGUMENTS_H_
#define UNDERSTUDY_REMOTE_ARGUMENTS_H_

#include <string>

#include "client/robot_choice.h"
#include "remote/pad_mapping.h"

namespace CLI {
class App;
}

namespace understudy::remote {

struct RemoteArguments {
  client::RobotChoice robot;
  std::string gamepad;  // a number or part of a name; "" for the first that is known
  std::string mapping;  // a file; "" for none
  double dead_zone = kDeadZone;
  bool no_keyboard = false;
  bool list_gamepads = false;
};

// Adds the subcommand with its options, which must outlive the parsing.
CLI::App* AddRemoteCommand(CLI::App* app, RemoteArguments* arguments);

// What a build that has no understudy-remote says.
inline constexpr char kRemoteMissing[] = "build the target understudy-remote, or run ./tools/up";

}  // namespace understudy::remote

#endif  // UNDERSTUDY_REMOTE_ARGUMENTS_H_
