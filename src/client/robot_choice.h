// Selects the running robot that a command line names.
#pragma once

#include <filesystem>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace understudy::client {

// The values of --name and --socket. If both are "", $UNDERSTUDY_CONTROL (a socket's path) selects
// the robot, else the only running robot is selected.
struct RobotChoice {
  std::string name;
  std::string socket;
};

// Adds the two options to `command`. `choice` must outlive the parsing.
void AddRobotChoice(CLI::App* command, RobotChoice* choice);

// The socket of the selected robot, or the reason why there is none yet.
struct RobotPlace {
  std::optional<std::filesystem::path> socket;
  std::string why;
};

// Asks on `out` which robot is meant and reads a number or a name from `in`, repeatedly until the
// answer is valid. Returns nullopt at the end of `in`.
std::optional<std::string> AskWhich(const std::vector<std::string>& names, std::istream& in,
                                    std::ostream& out);

// Finds the selected robot. If several run and none is selected, asks if stdin is a terminal, else
// throws ControlError. Throws SocketError for an invalid name.
RobotPlace FindRobot(const RobotChoice& choice);

// As above, but throws ControlError, with the nearest name, if no robot of that name runs.
std::filesystem::path ChosenSocket(const RobotChoice& choice);

}  // namespace understudy::client
