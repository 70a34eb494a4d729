// Opens a WebSocket to a running robot.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <string>

namespace understudy::client {

// One WebSocket, used by one thread.
class ControlStream {
 public:
  // `target`: "/frames?hz=60&parts=qpos,contacts" or "/orders". Throws ControlError when nobody
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
