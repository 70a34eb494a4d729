// The door of a running robot for the programs of its user: HTTP/1.1 with JSON on a Unix socket.
#ifndef UNDERSTUDY_CONTROL_SERVER_H_
#define UNDERSTUDY_CONTROL_SERVER_H_

#include <chrono>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>

#include "control/inbox.h"
#include "control/status.h"
#include "robot/randomization.h"

namespace understudy {

// What one client may cost; all *assumed*, far above what our own clients need.
struct ServerLimits {
  std::size_t header_bytes = 8 * 1024;
  std::size_t body_bytes = 64 * 1024;
  std::size_t connections = 64;
  // For a whole request to arrive, from the one before it, and for a whole reply to be taken.
  std::chrono::milliseconds idle{10'000};
  // For the tick to carry an order out; afterwards it is answered 503 and not carried out any more.
  std::chrono::milliseconds patience{2'000};
};

// Serves from construction to destruction, on one thread of its own which never waits for a client
// or for the tick.
//
//   GET  /status                                         see StatusJson
//   POST /crane  {"lower": m} {"raise": m} {"attach": true} {"release": true}
//   POST /clamp  {"on": bool}
//   POST /reset  {}
//
// An order is answered 200 {"ok": true}, else {"error": "..."} with 400 for what cannot be read,
// 404 and 405 for a wrong path and method, 409 when the robot refuses, 413 and 431 for a body and a
// header too large, 503 when the robot does not come to it or there are too many clients.
class ControlServer {
 public:
  // Listens at `socket`, in a folder that exists (MakeControlFolder). `board` and `inbox` must
  // outlive the server. `draws`: what the run left to chance, which the status tells. Throws
  // SocketError as ListeningSocket does.
  ControlServer(const std::filesystem::path& socket, const std::string& robot,
                const StatusBoard* board, Inbox* inbox, const ServerLimits& limits = {},
                Draws draws = {});
  // Hangs up on whoever is connected and removes the socket file.
  ~ControlServer();

  const std::filesystem::path& socket() const;

 private:
  class Loop;

  std::unique_ptr<Loop> loop_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_SERVER_H_
