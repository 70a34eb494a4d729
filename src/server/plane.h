// The server's connections to the running robot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "emulator/inbox.h"
#include "emulator/snapshot_mailbox.h"
#include "emulator/status.h"
#include "server/bus_view.h"
#include "server/event_history.h"
#include "server/recordings.h"
#include "server/scene_files.h"
#include "server/static_files.h"
#include "server/status_json.h"
#include "services/api_row.h"

namespace understudy::server {

// For the server's thread. The pointers must outlive it.
struct Plane {
  RobotIdentity identity;
  const emulator::StatusBoard* board = nullptr;
  emulator::Inbox* inbox = nullptr;
  emulator::SnapshotMailbox* snapshots = nullptr;  // null: no snapshots
  EventHistory events{};
  std::optional<SceneFiles> scene{};  // nullopt: no scene
  BusView bus{};
  Recordings recordings{};
  std::vector<services::ServiceTable> services{};
  StaticFiles files{""};            // of the panel
  std::filesystem::path openapi{};  // the OpenAPI document
  std::string url{};                // of the panel, with the token; "" without a TCP socket
};

}  // namespace understudy::server
