// The command `understudy ctl`: reads the state of a running robot and sends requests.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/exit_code.h"
#include "client/robot_choice.h"
#include "emulator/request.h"

namespace CLI {
class App;
}

namespace understudy::ctl {

// Adds the subcommand `ctl` to a command line and runs it if parsing has `chosen` it:
//
//   status [--watch]   wait   list   snapshot [--watch]   damage [--check]   scene
//   events [--follow]   timings   metrics   stop   panel
//
// and every request of the table (emulator/request.h): pause, crane lower BY, push BODY FORCE ...
// Each takes --json, and --name NAME or --socket PATH; without these, $UNDERSTUDY_CONTROL (a socket
// path) selects the robot, else the only running one is selected. For an invalid command line
// App::parse throws CLI::ParseError.
class CtlCommand {
 public:
  // Both pointers must outlive this object, and this object the parsing.
  CtlCommand(CLI::App* app, std::ostream* out);
  CtlCommand(const CtlCommand&) = delete;
  CtlCommand& operator=(const CtlCommand&) = delete;

  // Returns, after App::parse, whether the command line has a subcommand of `ctl`.
  bool chosen() const { return action_ != nullptr; }

  // Runs that subcommand. Throws ControlError if the robot refuses or is not there, if several run
  // and none is named, and if `wait` times out.
  // Returns the exit code.
  ExitCode Run() {
    action_();
    return code_;
  }

 private:
  // Formats the JSON of a reply for a person.
  using Teller = std::string (*)(const nlohmann::ordered_json& reply);

  CLI::App* AddAction(CLI::App* parent, const std::string& name, const std::string& help,
                      std::function<void()> action);
  void AddReading(CLI::App* ctl);
  void AddDamage(CLI::App* ctl);
  void AddRequests(CLI::App* ctl);
  void AddRequest(CLI::App* parent, const std::string& verb, const emulator::RequestRow& row);

  void ShowStatus() const;
  void WatchStatus(const std::filesystem::path& socket) const;
  void ShowSnapshots() const;
  void ShowDamage();
  void ShowEvents() const;
  void ShowLog() const;
  void AwaitReady() const;
  void ShowRobots() const;
  // Sends SIGTERM to the process of the robot and waits for its end.
  void Stop() const;
  // Prints the reply to GET `path`: unchanged with --json, else as formatted by `tell`.
  void Show(const std::string& path, Teller tell) const;

  void Request(const emulator::RequestRow& row, const nlohmann::json& values) const;

  std::ostream* out_;
  std::function<void()> action_;
  client::RobotChoice robot_;
  bool json_ = false;
  bool watch_ = false;
  bool all_ = false;
  bool check_ = false;
  ExitCode code_ = ExitCode::kOk;
  double timeout_ = 30;  // s
  double every_ = 1;     // s
  double hz_ = 60;
  std::string parts_;
  std::deque<std::vector<std::vector<std::string>>> words_;  // by request and field, as typed
};

}  // namespace understudy::ctl
