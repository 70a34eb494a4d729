// Where observers reach the robots of this process.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "config/config.h"
#include "exec/child_process.h"
#include "run/run.h"
#include "server/panel_socket.h"

namespace understudy::commands {

// The name by which `ctl` finds a robot of this process. `name` is that of --name, "" without; of
// several robots it stands before their own.
std::string ControlName(const std::string& name, const config::Config& config,
                        const config::RobotConfig& robot);

// The control sockets and panels, for as long as the run.
class ControlPlace {
 public:
  // Throws SocketError.
  ControlPlace(const std::string& name, const config::Config& config);
  ~ControlPlace();
  ControlPlace(const ControlPlace&) = delete;
  ControlPlace& operator=(const ControlPlace&) = delete;

  // Gives each robot a panel. The port of the configuration is that of the first; the others have
  // those after it. Throws SocketError if a configured address or port cannot be had.
  void AddPanels(const config::Config& config);

  const std::vector<run::Access>& access() const { return access_; }
  const std::filesystem::path& socket() const { return access_.front().socket; }  // of the first
  const std::string& missing() const { return missing_; }  // why there is no panel; "" if there is
  // For a program beside the robots: UNDERSTUDY_CONTROL is the first's socket, and of several
  // UNDERSTUDY_CONTROL_<name> that of each.
  const exec::ChildProcess::Environment& environment() const { return environment_; }

 private:
  std::filesystem::path folder_;
  std::vector<run::Access> access_;
  exec::ChildProcess::Environment environment_;
  std::vector<std::unique_ptr<server::PanelSocket>> panels_;
  std::string missing_;
};

}  // namespace understudy::commands
