// Orders from a window to its robot, without the window waiting for an answer.
#ifndef UNDERSTUDY_VIEWER_ORDER_SENDER_H_
#define UNDERSTUDY_VIEWER_ORDER_SENDER_H_

#include <condition_variable>
#include <deque>
#include <filesystem>
#include <mutex>
#include <stop_token>
#include <string>
#include <thread>

#include <nlohmann/json.hpp>

namespace understudy::viewer {

class OrderSender {
 public:
  explicit OrderSender(const std::filesystem::path& socket);

  // An order as POST `path` takes it. A drag replaces one that still waits.
  void Send(const std::string& path, const nlohmann::json& body);

  // The last refusal since the last call, "" for none.
  std::string TakeRefusal();
  // Which motion service holds the motors, asked once a second; "" before it is known.
  std::string service() const;

 private:
  struct Order {
    std::string path;
    nlohmann::json body;
  };

  void Run(const std::stop_token& stop, const std::filesystem::path& socket);
  void Serve(const std::stop_token& stop, const std::filesystem::path& socket);
  void AskService(const std::filesystem::path& socket);

  mutable std::mutex mutex_;
  std::condition_variable_any news_;
  std::deque<Order> waiting_;
  std::string refusal_;
  std::string service_;
  std::jthread thread_;  // last: it uses all of the above
};

}  // namespace understudy::viewer

#endif  // UNDERSTUDY_VIEWER_ORDER_SENDER_H_
