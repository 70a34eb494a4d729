// Which request is answered how: the control plane without its transport.
#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "emulator/inbox.h"
#include "server/http.h"
#include "server/plane.h"

namespace understudy::server {

// A reply that is made of a frame.
struct FromFrame {
  emulator::FrameParts parts = 0;
  HttpReply (*reply)(const emulator::Frame& frame, emulator::FrameParts parts,
                     Plane& plane) = nullptr;
};

// A WebSocket on which frames are sent, at most `hz` a second.
struct WatchFrames {
  emulator::FrameParts parts = 0;
  double hz = 60;
};

// A WebSocket on which events are sent.
struct WatchEvents {};

// A WebSocket on which requests come.
struct TakeRequests {};

// A reply at once, a request that has to be carried out before one is known, or another beginning.
using Routed =
    std::variant<HttpReply, emulator::Request, FromFrame, WatchFrames, WatchEvents, TakeRequests>;

// What a request came to: {"ok": true}, or 409 with the reason.
HttpReply AnswerReply(const emulator::Answer& answer);

// Never throws on what a client sent.
Routed Route(const HttpRequest& request, Plane& plane);

// One route as documents name it: "GET", "/scene/mesh/{index}".
struct RouteName {
  std::string method;
  std::string path;
};
std::vector<RouteName> AllRoutes();

}  // namespace understudy::server
