// Waits for the tick's answer to an order without waiting in a thread. Sees Boost; for the server's
// own files only.
#ifndef UNDERSTUDY_SERVER_ORDER_WAIT_H_
#define UNDERSTUDY_SERVER_ORDER_WAIT_H_

#include <chrono>
#include <functional>
#include <future>
#include <optional>

#include <boost/asio/steady_timer.hpp>

#include "emulator/inbox.h"
#include "server/http.h"

namespace understudy::server {

// One order at a time.
class OrderWait {
 public:
  using Done = std::function<void(const HttpReply&)>;

  template <class Executor>
  OrderWait(const Executor& executor, emulator::Inbox* inbox, std::chrono::milliseconds patience)
      : inbox_(inbox), patience_(patience), timer_(executor) {}

  // Calls `done`, which keeps this alive, with the reply: the tick's, or 503 where the inbox is
  // full or the tick has not come to it in time.
  void Begin(const emulator::Order& order, Done done);

 private:
  void Look(Done done);

  emulator::Inbox* inbox_;
  std::chrono::milliseconds patience_;
  boost::asio::steady_timer timer_;
  std::optional<std::future<emulator::Answer>> answer_;
  std::chrono::steady_clock::time_point until_;
};

}  // namespace understudy::server

#endif  // UNDERSTUDY_SERVER_ORDER_WAIT_H_
