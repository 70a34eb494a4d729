// `understudy ctl`: asks a running robot for its state and gives it orders.
#ifndef UNDERSTUDY_CONTROL_CTL_COMMAND_H_
#define UNDERSTUDY_CONTROL_CTL_COMMAND_H_

#include <chrono>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "control/client.h"

namespace CLI {
class App;
}

namespace understudy {

// Adds the subcommand `ctl` to a command line and runs it once that was parsed and is `chosen`:
//
//   status [--json] [--watch]   wait [--timeout S]   list [--json]
//   crane lower M | raise M | attach | release   clamp on | off   reset
//   push BODY FX FY FZ [--for S]   remote press | hold | release KEYS, stick AXIS=VALUE, on, off
//
// each with --name NAME or --socket PATH; without them $UNDERSTUDY_CONTROL (a socket path), else
// the only robot that runs. What cannot be understood makes App::parse throw CLI::ParseError.
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
  // Where the robot is that the options mean, or why there is none yet.
  struct Target {
    std::optional<std::filesystem::path> socket;
    std::string why;
  };

  CLI::App* AddAction(CLI::App* parent, const std::string& name, const std::string& help,
                      std::function<void()> action);
  void AddCrane(CLI::App* ctl);
  void AddPush(CLI::App* ctl);
  void AddRemote(CLI::App* ctl);

  Target FindTarget() const;
  std::filesystem::path TargetSocket() const;
  void ShowStatus() const;
  void AwaitReady() const;
  void ShowRobots() const;
  void GiveOrder(const std::string& path, const nlohmann::json& body) const;

  std::ostream* out_;
  std::function<void()> action_;
  std::string name_;
  std::string socket_;
  bool json_ = false;
  bool watch_ = false;
  double timeout_ = 30;  // s
  double metres_ = 0;
  double seconds_ = 0;
  std::string body_, keys_;
  std::vector<double> force_;
  std::vector<std::string> axes_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_CTL_COMMAND_H_
