// Hands requests to the tick and answers who waits for it, without waiting in a thread. Sees Boost;
// for the server's own files only.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <future>
#include <map>

#include <boost/asio/io_context.hpp>
#include <boost/asio/posix/stream_descriptor.hpp>
#include <boost/asio/steady_timer.hpp>

#include "emulator/inbox.h"
#include "server/http.h"

namespace understudy::server {

// Of all connections. Woken by the inbox's bell.
class RequestDesk {
 public:
  using Done = std::function<void(const HttpReply&)>;

  // `inbox` must outlive the desk. `patience`: for the tick to come to a request.
  RequestDesk(boost::asio::io_context* io, emulator::Inbox* inbox,
              std::chrono::milliseconds patience);

  // Calls `done`, which keeps alive whatever it needs, with the reply: the tick's, or 503 where the
  // inbox is full or the tick has not come to it in time. What is answered when its steps are made
  // has no limit.
  void Ask(const emulator::Request& request, Done done);

 private:
  struct Asked {
    std::future<emulator::Answer> answer;
    boost::asio::steady_timer timer;
    Done done;
  };

  void Listen();
  void Deliver();

  boost::asio::io_context* io_;
  emulator::Inbox* inbox_;
  std::chrono::milliseconds patience_;
  boost::asio::posix::stream_descriptor bell_;
  std::uint64_t rings_ = 0;
  std::uint64_t asked_before_ = 0;
  std::map<std::uint64_t, Asked> asked_;  // in order of arrival
};

}  // namespace understudy::server
