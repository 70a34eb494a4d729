// Passes requests to the tick and its answers to the connections, without blocking. Includes Boost;
// private to server/.
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

// The waiting requests of all connections. Woken by the inbox's bell.
class RequestDesk {
 public:
  using Done = std::function<void(const HttpReply&)>;

  // `inbox` must outlive the desk. `patience` is the longest wait until the tick takes a request.
  RequestDesk(boost::asio::io_context* io, emulator::Inbox* inbox,
              std::chrono::milliseconds patience);

  // Calls `done`, which must own what it needs, with the reply: the tick's, or 503 if the inbox is
  // full or the tick did not take the request in time, which then is never carried out.
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
  std::map<std::uint64_t, Asked> asked_;  // by the inbox's number: in order of arrival
};

}  // namespace understudy::server
