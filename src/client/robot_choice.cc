#include "client/robot_choice.h"

#include <algorithm>
#include <cstdlib>
#include <iostream>

#include <CLI/CLI.hpp>
#include <unistd.h>

#include "base/errors.h"
#include "base/log_line.h"
#include "base/nearest_word.h"
#include "client/client.h"
#include "client/control_folder.h"

namespace understudy::client {
namespace {

std::vector<std::string> NamesOf(const std::vector<RunningRobot>& robots) {
  std::vector<std::string> names;
  for (const RunningRobot& robot : robots) names.push_back(robot.name);
  return names;
}

std::string Listed(const std::vector<std::string>& names) {
  std::string list;
  for (const std::string& name : names) list += (list.empty() ? "" : ", ") + name;
  return list;
}

RobotPlace FindNamed(const std::string& name, const std::vector<RunningRobot>& robots) {
  const auto it = std::find_if(robots.begin(), robots.end(),
                               [&](const RunningRobot& robot) { return robot.name == name; });
  if (it != robots.end()) return {.socket = it->socket, .why = {}};
  // Its default name without the process, if only one has that.
  const auto is = [&name](const RunningRobot& robot) {
    return robot.name == name + "-" + std::to_string(robot.pid);
  };
  if (std::ranges::count_if(robots, is) == 1) {
    return {.socket = std::ranges::find_if(robots, is)->socket, .why = ""};
  }
  const std::vector<std::string> names = NamesOf(robots);
  const std::string nearest = NearestWord(name, names);
  const std::string hint = !nearest.empty() ? ": did you mean \"" + nearest + "\"?"
                           : names.empty()  ? ""
                                            : "; there are " + Listed(names);
  return {.socket = {}, .why = "no robot named \"" + name + "\" runs" + hint};
}

}  // namespace

void AddRobotChoice(CLI::App* command, RobotChoice* choice) {
  CLI::Option* name = command->add_option("--name,--robot", choice->name,
                                          "The robot's name; `understudy ctl list` shows them");
  command
      ->add_option("--socket", choice->socket,
                   "The robot's control socket [else $UNDERSTUDY_CONTROL, else the only one]")
      ->excludes(name);
}

std::optional<std::string> AskWhich(const std::vector<std::string>& names, std::istream& in,
                                    std::ostream& out) {
  out << "several robots run:\n";
  for (std::size_t i = 0; i < names.size(); ++i) out << "  " << i + 1 << "  " << names[i] << "\n";
  while (true) {
    out << "which one? " << std::flush;
    std::string answer;
    if (!std::getline(in, answer)) return std::nullopt;
    for (std::size_t i = 0; i < names.size(); ++i) {
      if (answer == names[i] || answer == std::to_string(i + 1)) return names[i];
    }
    out << "a number from 1 to " << names.size() << ", or a name, please\n";
  }
}

RobotPlace FindRobot(const RobotChoice& choice) {
  if (!choice.socket.empty()) return {.socket = choice.socket, .why = {}};
  const char* from_environment = std::getenv("UNDERSTUDY_CONTROL");
  const bool named = !choice.name.empty();
  if (!named && from_environment != nullptr && *from_environment != '\0') {
    return {.socket = from_environment, .why = {}};
  }
  if (named) ControlSocket(choice.name);  // throws for an invalid name

  const std::vector<RunningRobot> robots = FindRobots();
  if (named) return FindNamed(choice.name, robots);
  if (robots.empty()) {
    return {.socket = {}, .why = "no robot runs; start one, as in `understudy run g1`"};
  }
  if (robots.size() == 1) return {.socket = robots.front().socket, .why = {}};
  const std::vector<std::string> names = NamesOf(robots);
  if (!SpeaksJson() && ::isatty(STDIN_FILENO) == 1 && ::isatty(STDERR_FILENO) == 1) {
    if (const auto name = AskWhich(names, std::cin, std::cerr)) return FindNamed(*name, robots);
  }
  throw ControlError("several robots run (" + Listed(names) + "); choose one with --robot NAME");
}

std::filesystem::path ChosenSocket(const RobotChoice& choice) {
  RobotPlace place = FindRobot(choice);
  if (!place.socket) throw ControlError(place.why);
  return *place.socket;
}

}  // namespace understudy::client
