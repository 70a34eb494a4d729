// Finds running robots and sends them requests.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include <sys/types.h>

namespace understudy::client {

struct RunningRobot {
  std::string name;
  std::filesystem::path socket;
  pid_t pid = 0;  // 0 if unknown: in another process namespace, or too busy
};

// Returns the robots whose sockets are in the control folder, sorted by name; none if there is no
// such folder. Removes the sockets of dead processes. Throws SocketError if others may access the
// folder.
std::vector<RunningRobot> FindRobots();

struct ControlReply {
  unsigned status = 0;  // HTTP status
  std::string body;
};

// A connection to a robot for one request after another. The robot closes it after
// ServerLimits::idle without a request.
class ControlConnection {
 public:
  // Throws ControlError if nothing listens at `socket`.
  ControlConnection(const std::filesystem::path& socket, std::chrono::milliseconds timeout);
  ~ControlConnection();
  ControlConnection(const ControlConnection&) = delete;
  ControlConnection& operator=(const ControlConnection&) = delete;

  // Sends a request and returns the reply, of any status. Throws ControlError if no HTTP reply
  // comes within `timeout`; the connection is then unusable. `last` closes the connection after the
  // reply.
  ControlReply Ask(const std::string& method, const std::string& path, const std::string& body,
                   std::chrono::milliseconds timeout, bool last = false);

 private:
  struct Stream;
  std::filesystem::path socket_;
  std::unique_ptr<Stream> stream_;
};

// Sends one request on a new connection. Connecting and asking may take `timeout` each. Throws
// ControlError.
ControlReply Call(const std::filesystem::path& socket, const std::string& method,
                  const std::string& path, const std::string& body,
                  std::chrono::milliseconds timeout);

// One WebSocket, used by one thread.
class ControlStream {
 public:
  // `target` is "/snapshots?hz=60&parts=qpos,contacts" or "/requests". Throws ControlError if
  // nothing listens at `socket`, the robot refuses (with its reason) or nothing comes within
  // `timeout`, which also limits each later call.
  ControlStream(const std::filesystem::path& socket, const std::string& target,
                std::chrono::milliseconds timeout);
  ~ControlStream();
  ControlStream(ControlStream&& other) noexcept;
  ControlStream& operator=(ControlStream&& other) noexcept;

  // Waits for the next message and returns it. Throws ControlError if the robot has gone or none
  // comes in time.
  std::string Next();
  void Send(const std::string& message);

 private:
  class Impl;

  std::unique_ptr<Impl> impl_;
};

}  // namespace understudy::client
