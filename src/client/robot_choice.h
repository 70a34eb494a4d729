// Picks the running robot that a command line names.
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

// What --name and --socket said; without either $UNDERSTUDY_CONTROL (a socket's path), else the
// only robot that runs.
struct RobotChoice {
  std::string name;
  std::string socket;
};

// Adds the two options. `choice` must outlive the parsing.
void AddRobotChoice(CLI::App* command, RobotChoice* choice);

// The socket of that robot, or why it cannot be told yet.
struct RobotPlace {
  std::optional<std::filesystem::path> socket;
  std::string why;
};

// Asks on `out` which of them is meant and reads the answer, a number or a name, from `in`. Repeats
// the question when it is neither. nullopt at the end of `in`.
std::optional<std::string> AskWhich(const std::vector<std::string>& names, std::istream& in,
                                    std::ostream& out);

// When several run and none was chosen, asks which one if stdin is a terminal. Throws ControlError
// when it is not, SocketError for a name that is not allowed.
RobotPlace FindRobot(const RobotChoice& choice);

// As above, but throws ControlError, with the nearest name, when no robot runs by that name.
std::filesystem::path ChosenSocket(const RobotChoice& choice);

}  // namespace understudy::client
