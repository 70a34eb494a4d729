// What the server reads from and writes to the running robot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "emulator/inbox.h"
#include "emulator/snapshot_mailbox.h"
#include "emulator/status.h"
#include "server/event_history.h"
#include "server/scene_files.h"
#include "server/static_files.h"
#include "server/status_json.h"

namespace understudy::server {

// Belongs to the server's thread; what it points to outlives it.
struct Plane {
  RobotIdentity identity;
  const emulator::StatusBoard* board = nullptr;
  emulator::Inbox* inbox = nullptr;
  emulator::SnapshotMailbox* frames = nullptr;  // null: nothing is to be seen
  EventHistory events{};
  std::optional<SceneFiles> scene{};  // likewise
  StaticFiles files{""};              // the panel's
  std::filesystem::path openapi{};    // the document of the routes
  std::string url{};                  // of the panel, with the token; "" without a TCP socket
};

}  // namespace understudy::server
