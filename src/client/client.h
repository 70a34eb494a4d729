// Finds running robots and asks them.
#ifndef UNDERSTUDY_CLIENT_CLIENT_H_
#define UNDERSTUDY_CLIENT_CLIENT_H_

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

// The robots whose sockets are in the control folder, by name; none when there is no such folder.
// Sockets of dead processes are removed on the way. Throws SocketError for a folder that is not
// this user's alone.
std::vector<RunningRobot> FindRobots();

struct ControlReply {
  unsigned status = 0;  // of HTTP
  std::string body;
};

// A connection to a robot for requests one after another. A robot hangs up on who asks nothing for
// ServerLimits::idle.
class Connection {
 public:
  // Throws ControlError when nobody listens at `socket`.
  Connection(const std::filesystem::path& socket, std::chrono::milliseconds timeout);
  ~Connection();
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  // A reply of any status is a reply. Throws ControlError when no HTTP comes back within `timeout`;
  // the connection is of no use any more then, nor after `last`, which tells the robot so.
  ControlReply Ask(const std::string& method, const std::string& path, const std::string& body,
                   std::chrono::milliseconds timeout, bool last = false);

 private:
  struct Stream;
  std::filesystem::path socket_;
  std::unique_ptr<Stream> stream_;
};

// One request on a connection of its own, connecting and asking within `timeout` each.
ControlReply Call(const std::filesystem::path& socket, const std::string& method,
                  const std::string& path, const std::string& body,
                  std::chrono::milliseconds timeout);

}  // namespace understudy::client

#endif  // UNDERSTUDY_CLIENT_CLIENT_H_
