// Sends requests from a window to its robot without waiting for the answers.
#pragma once

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

namespace understudy::viewer {

class RequestSender {
 public:
  explicit RequestSender(const std::filesystem::path& socket);

  // Sends a request of the table with its values. A drag replaces a waiting one.
  void Send(const std::string& name, const nlohmann::json& values = nlohmann::json::object());

  // Returns the last refusal since the last call, "" for none.
  std::string TakeRefusal();
  // Returns who moves the motors, as of the last second; "" before it is known.
  std::string motors() const;

 private:
  struct Request {
    std::string name;
    nlohmann::json values;
  };

  void Run(const std::stop_token& stop, const std::filesystem::path& socket);
  void Serve(const std::stop_token& stop, const std::filesystem::path& socket);
  void AskStatus(const std::filesystem::path& socket);

  mutable std::mutex mutex_;
  std::condition_variable_any news_;
  std::deque<Request> waiting_;
  std::string refusal_;
  std::string motors_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::viewer
