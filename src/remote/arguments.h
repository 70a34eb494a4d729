// The command line of `understudy remote`. Without SDL, since `understudy` parses it too, for
// --help and completions.
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
  std::string gamepad;  // a number or part of a name; "" for the first known one
  std::string mapping;  // a file; "" for none
  double dead_zone = kDeadZone;
  bool no_keyboard = false;
  bool list_gamepads = false;
};

// Adds the subcommand with its options, which must outlive the parsing.
CLI::App* AddRemoteCommand(CLI::App* app, RemoteArguments* arguments);

// The hint of a build without understudy-remote.
inline constexpr char kRemoteMissing[] = "build the target understudy-remote, or run ./tools/up";

}  // namespace understudy::remote
