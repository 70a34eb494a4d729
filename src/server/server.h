// The server of a running robot: HTTP/1.1 with JSON and WebSockets, on a Unix socket for the
// programs of its user and on TCP for a browser.
#pragma once

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "server/panel_socket.h"
#include "server/plane.h"

namespace understudy::server {

// What one client may cost; all *assumed*, far above what our own clients need.
struct ServerLimits {
  std::size_t header_bytes = 8 * 1024;
  std::size_t body_bytes = 64 * 1024;  // of a message on a WebSocket too
  std::size_t connections = 64;        // of each socket
  // For a whole request to arrive, from the one before it, and for a whole reply to be taken; for a
  // WebSocket to give a sign of life.
  std::chrono::milliseconds idle{10'000};
  // For the tick to carry a request out; afterwards it is answered 503 and not carried out any
  // more. Likewise for a frame.
  std::chrono::milliseconds patience{2'000};
};

// Serves from construction to destruction, on one thread of its own which never waits for a client
// or for the tick. Both sockets have the same routes (docs/openapi.yaml); on TCP whatever writes
// needs this run's token, see server/access.h.
//
// A request is answered 200 {"ok": true}, else {"error": "..."} with 400 for what cannot be read,
// 401 and 403 for who may not, 404 and 405 for a wrong path and method, 409 when the robot refuses,
// 413 and 431 for a body and a header too large, 503 when the robot does not come to it or there
// are too many clients.
class ControlServer {
 public:
  // Listens at `socket`, in a folder that exists (MakeControlFolder), and at `panel` unless that is
  // null. What `plane` points to must outlive the server; its url is filled in here, as are version
  // and pid. Throws SocketError as ListeningSocket does.
  ControlServer(const std::filesystem::path& socket, Plane plane, const ServerLimits& limits = {},
                const PanelSocket* panel = nullptr);
  // Hangs up on whoever is connected and removes the socket file.
  ~ControlServer();

  const std::filesystem::path& socket() const;
  // Of the panel, with the token: "http://127.0.0.1:7707/#token=..."; "" where there is none.
  const std::string& url() const;

 private:
  class Loop;

  std::unique_ptr<Loop> loop_;
};

}  // namespace understudy::server
