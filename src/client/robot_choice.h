// Which running robot a command line means.
#ifndef UNDERSTUDY_CLIENT_ROBOT_CHOICE_H_
#define UNDERSTUDY_CLIENT_ROBOT_CHOICE_H_

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

// Where that robot is, or why there is none yet.
struct RobotPlace {
  std::optional<std::filesystem::path> socket;
  std::string why;
};

// Asks on `out` which of them is meant and reads the answer, a number or a name, from `in`; again
// where it is neither. nullopt when there is no answer.
std::optional<std::string> AskWhich(const std::vector<std::string>& names, std::istream& in,
                                    std::ostream& out);

// Where several run and none was chosen asks which, if a person sits at the terminal. Throws
// ControlError when nobody does, SocketError for what can be no name.
RobotPlace FindRobot(const RobotChoice& choice);

// The same where there has to be one: throws ControlError, with the nearest name, when there is
// not.
std::filesystem::path ChosenSocket(const RobotChoice& choice);

}  // namespace understudy::client

#endif  // UNDERSTUDY_CLIENT_ROBOT_CHOICE_H_
