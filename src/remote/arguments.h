// Arguments of `understudy remote`. Knows no SDL: the daemon's program parses these too, for --help
// and completions.
#pragma once

#include <string>

#include "client/robot_choice.h"
#include "remote/gamepad_mapping.h"

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

// The error of a build that has no understudy-remote.
inline constexpr char kRemoteMissing[] = "build the target understudy-remote, or run ./tools/up";

}  // namespace understudy::remote
