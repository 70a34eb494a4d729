// The server's connections to the running robot.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/inbox.h"
#include "emulator/snapshot_mailbox.h"
#include "emulator/status.h"
#include "server/bus_view.h"
#include "server/camera_views.h"
#include "server/event_history.h"
#include "server/recordings.h"
#include "server/scene_files.h"
#include "server/sight.h"
#include "server/static_files.h"
#include "server/status_json.h"
#include "services/api_row.h"

namespace understudy::server {

// A robot of the world and its panel.
struct RobotPanel {
  std::string name{};
  std::string url{};  // with the token; "" without a panel
};

// For the server's thread. The pointers must outlive it.
struct Plane {
  RobotIdentity identity;
  std::size_t robot = 0;  // its number in the world, for requests that name none
  const emulator::StatusBoard* board = nullptr;
  emulator::Inbox* inbox = nullptr;
  emulator::SnapshotMailbox* snapshots = nullptr;  // null: no snapshots
  CameraViews* views = nullptr;                    // null: no cameras
  EventHistory events{};
  std::optional<SceneFiles> scene{};  // nullopt: no scene
  BusView bus{};
  Sight sight{};
  Recordings recordings{};
  std::vector<services::ServiceTable> services{};
  StaticFiles files{""};             // of the panel
  std::filesystem::path openapi{};   // the OpenAPI document
  std::vector<RobotPanel> robots{};  // of a world of several, by number; else empty
  std::string url{};                 // of the panel, with the token; "" without a TCP socket
};

}  // namespace understudy::server
