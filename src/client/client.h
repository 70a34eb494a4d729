// Finds running robots and asks them.
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
  pid_t pid = 0;  // 0 when it is out of sight (another process namespace) or too busy to tell
};

// Lists the robots whose sockets are in the control folder, by name; none when there is no such
// folder. Removes the sockets of dead processes. Throws SocketError for a folder that is not this
// user's alone.
std::vector<RunningRobot> FindRobots();

struct ControlReply {
  unsigned status = 0;  // of HTTP
  std::string body;
};

// A connection to a robot that carries one request after another. The robot closes it when no
// request comes for ServerLimits::idle.
class Connection {
 public:
  // Throws ControlError when nobody listens at `socket`.
  Connection(const std::filesystem::path& socket, std::chrono::milliseconds timeout);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // Sends a request and returns the reply, whatever its status. Throws ControlError when no HTTP
  // comes back within `timeout`. After that, or after `last`, which tells the robot so, the
  // connection cannot be used.
  ControlReply Ask(const std::string& method, const std::string& path, const std::string& body,
                   std::chrono::milliseconds timeout, bool last = false);

 private:
  struct Stream;
  std::filesystem::path socket_;
  std::unique_ptr<Stream> stream_;
};

// Sends one request on a connection of its own, connecting and asking within `timeout` each.
ControlReply Call(const std::filesystem::path& socket, const std::string& method,
                  const std::string& path, const std::string& body,
                  std::chrono::milliseconds timeout);

// One WebSocket, used by one thread.
class ControlStream {
 public:
  // `target`: "/frames?hz=60&parts=qpos,contacts" or "/requests". Throws ControlError when nobody
  // listens at `socket` or it is refused (with the reason) or nothing comes within `timeout`, which
  // also limits every later call.
  ControlStream(const std::filesystem::path& socket, const std::string& target,
                std::chrono::milliseconds timeout);
  ~ControlStream();
  ControlStream(ControlStream&& other) noexcept;
  ControlStream& operator=(ControlStream&& other) noexcept;

  // Waits for the next message and returns it. Throws ControlError when the robot has gone or none
  // comes in time.
  std::string Next();
  void Send(const std::string& message);

 private:
  class Impl;

  std::unique_ptr<Impl> impl_;
};

}  // namespace understudy::client
