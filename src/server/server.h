// Serves a running robot: HTTP/1.1 with JSON and WebSockets, on a Unix socket for programs of its
// user and on TCP for a browser.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "server/panel_socket.h"
#include "server/plane.h"

namespace understudy::server {

// Limits for clients; all *assumed*, far above the needs of our clients.
struct ServerLimits {
  std::size_t header_bytes = 8 * 1024;
  std::size_t body_bytes = 64 * 1024;  // also of a WebSocket message
  std::size_t connections = 64;        // per socket; WebSockets without the token have 3/4 of them
  // Longest time for a request to arrive completely, and for a reply to be read.
  std::chrono::milliseconds idle{10'000};
  // Longest time for a WebSocket to answer a ping, which waits behind the messages that a page has
  // yet to draw: on a loaded machine without a graphics card, ten seconds were seen.
  std::chrono::milliseconds silence{60'000};
  // Longest wait for the tick to take a request, which is then answered with 503 and not carried
  // out, or to fill in a snapshot.
  std::chrono::milliseconds patience{2'000};
  // Longest wait for a camera's picture. The first starts the program that draws.
  std::chrono::milliseconds picture{30'000};
};

// Serves while it exists, in one thread, which never waits for a client or for the tick. Both
// sockets have the same routes (openapi.yaml); on TCP, writing needs the token of the run
// (server/access.h).
//
// A request is answered with 200 {"ok": true}, or {"error": "..."} and 400 if it cannot be read,
// 401 or 403 if access is denied, 404 or 405 for a wrong path or method, 409 if the robot refuses,
// 413 or 431 for a too large body or header, 503 if the tick does not take it in time or there are
// too many clients, none of whom keeps the server waiting.
class ControlServer {
 public:
  // Listens at `socket`, whose folder must exist (MakeControlFolder), and at `panel` unless that is
  // null. The pointers of `plane` must outlive the server; its url, version and pid are filled in.
  // Throws SocketError as ListeningSocket does.
  ControlServer(const std::filesystem::path& socket, Plane plane, const ServerLimits& limits = {},
                const PanelSocket* panel = nullptr);
  // Closes all connections and removes the socket file.
  ~ControlServer();

  const std::filesystem::path& socket() const;
  // Returns the panel's URL with the token, "http://127.0.0.1:7707/#token=..."; "" if there is no
  // panel.
  const std::string& url() const;

 private:
  class Loop;

  std::unique_ptr<Loop> loop_;
};

}  // namespace understudy::server
