#include "commands/control_place.h"

#include "base/errors.h"
#include "client/control_folder.h"
#include "client/listening_socket.h"

namespace understudy::commands {
namespace {

// With the defaults it returns null where none can be had, and sets `missing` to the reason, as the
// panel is optional then.
std::unique_ptr<server::PanelSocket> MakePanelSocket(const config::ControlConfig& control,
                                                     int domain, std::string* missing) {
  if (!control.panel) return nullptr;
  try {
    return std::make_unique<server::PanelSocket>(control.address, control.port, domain);
  } catch (const SocketError& error) {
    if (control.port != 0 || control.address != config::ControlConfig{}.address) throw;
    *missing = error.what();
    return nullptr;
  }
}

}  // namespace

std::string ControlName(const std::string& name, const config::Config& config,
                        const config::RobotConfig& robot) {
  const bool alone = config.robots.size() == 1;
  if (name.empty()) return client::DefaultName(alone ? robot.spec.name : robot.name);
  return alone ? name : name + "-" + robot.name;
}

ControlPlace::ControlPlace(const std::string& name, const config::Config& config)
    : folder_(client::ControlFolder()) {
  for (const config::RobotConfig& robot : config.robots) {
    access_.push_back({.socket = client::ControlSocket(ControlName(name, config, robot))});
    if (config.robots.size() == 1) break;
    environment_.emplace_back("UNDERSTUDY_CONTROL_" + robot.name, access_.back().socket);
  }
  environment_.emplace_back("UNDERSTUDY_CONTROL", socket());
  client::MakeControlFolder(folder_);
}

ControlPlace::~ControlPlace() { client::RemoveControlFolder(folder_); }

void ControlPlace::AddPanels(const config::Config& config) {
  config::ControlConfig control = config.control;
  for (std::size_t i = 0; i < access_.size(); ++i) {
    panels_.push_back(MakePanelSocket(control, config.robots[i].network.domain, &missing_));
    access_[i].panel = panels_.back().get();
    if (control.port != 0) ++control.port;
  }
}

}  // namespace understudy::commands
