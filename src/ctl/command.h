// `understudy ctl`: asks a running robot for its state and makes requests.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "client/robot_choice.h"
#include "emulator/request.h"

namespace CLI {
class App;
}

namespace understudy::ctl {

// Adds the subcommand `ctl` to a command line and runs it once that was parsed and is `chosen`:
//
//   status [--watch]   wait   list   frame [--watch]   scene   events [--follow]   timings metrics
//   panel
//
// and every request of the table (emulator/request.h): pause, crane lower BY, push BODY FORCE ...;
// Each with --json, and --name NAME or --socket PATH; without them $UNDERSTUDY_CONTROL (a socket
// path), else the only robot that runs. What cannot be understood makes App::parse throw
// CLI::ParseError.
class CtlCommand {
 public:
  // Both pointers must outlive this object, which must outlive the parsing.
  CtlCommand(CLI::App* app, std::ostream* out);
  CtlCommand(const CtlCommand&) = delete;
  CtlCommand& operator=(const CtlCommand&) = delete;

  // After App::parse: one of the subcommands of `ctl` was asked for.
  bool chosen() const { return action_ != nullptr; }

  // Does it. Throws ControlError when the robot refuses or is not there, when several run and none
  // was named, and when `wait` ran out of time.
  void Run() { action_(); }

 private:
  // What makes text for a person of a reply's JSON.
  using Teller = std::string (*)(const nlohmann::ordered_json& reply);

  CLI::App* AddAction(CLI::App* parent, const std::string& name, const std::string& help,
                      std::function<void()> action);
  void AddReading(CLI::App* ctl);
  void AddRequests(CLI::App* ctl);
  void AddRequest(CLI::App* parent, const std::string& verb, const emulator::RequestRow& row);

  void ShowStatus() const;
  void WatchStatus(const std::filesystem::path& socket) const;
  void ShowFrames() const;
  void ShowEvents() const;
  void AwaitReady() const;
  void ShowRobots() const;
  // The reply to GET `path`: as it is with --json, else what `tell` makes of it.
  void Show(const std::string& path, Teller tell) const;

  void Request(const emulator::RequestRow& row, const nlohmann::json& values) const;

  std::ostream* out_;
  std::function<void()> action_;
  client::RobotChoice robot_;
  bool json_ = false;
  bool watch_ = false;
  double timeout_ = 30;  // s
  double every_ = 1;     // s
  double hz_ = 60;
  std::string parts_;
  std::deque<std::vector<std::vector<std::string>>> words_;  // by request and field, as typed
};

}  // namespace understudy::ctl
