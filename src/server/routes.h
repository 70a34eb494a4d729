// Routes HTTP requests to their replies: the control plane without its transport.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "emulator/inbox.h"
#include "server/http.h"
#include "server/plane.h"

namespace understudy::server {

// A reply made from a snapshot.
struct FromSnapshot {
  emulator::SnapshotParts parts = 0;
  HttpReply (*reply)(const emulator::Snapshot& snapshot, emulator::SnapshotParts parts,
                     Plane& plane) = nullptr;
};

// A picture by the camera of that number, or its depth.
struct FromCamera {
  std::size_t camera = 0;
  bool depth = false;
};

// A WebSocket that sends snapshots, at most `hz` a second.
struct WatchSnapshots {
  emulator::SnapshotParts parts = 0;
  double hz = 60;
};

// A WebSocket that sends events.
struct WatchEvents {};

// A WebSocket that takes requests.
struct TakeRequests {};

// An immediate reply, a request for the tick, a reply made from a snapshot, a picture, or a
// WebSocket.
using Routed = std::variant<HttpReply, emulator::Request, FromSnapshot, FromCamera, WatchSnapshots,
                            WatchEvents, TakeRequests>;

// Returns the reply to a carried out request: {"ok": true}, or 409 with the reason.
HttpReply AnswerReply(const emulator::Answer& answer);

// Routes a request. Never throws for any bytes of a client.
Routed Route(const HttpRequest& request, Plane& plane);

// One route in the notation of the documentation: "GET", "/scene/mesh/{index}".
struct RouteName {
  std::string method;
  std::string path;
};
std::vector<RouteName> AllRoutes();

}  // namespace understudy::server
