// A WebSocket on which events are sent. Sees Boost; for the server's own files only.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/web_socket.h"

namespace understudy::server {

// Sends each event of the history, and then each as it comes, one message each. What the client
// sends is read and left aside.
class EventWatch : public Connection {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  EventWatch(Stream stream, Request request, Connections* connections, Shared* shared);

  void Begin() override;
  void OnFrame(ShownFrame*) override {}

 private:
  std::shared_ptr<EventWatch> Self() {
    return std::static_pointer_cast<EventWatch>(shared_from_this());
  }
  void Listen();
  void Next();
  void Leave();

  Request request_;
  Connections* connections_;
  Shared* shared_;
  WebSocket stream_;
  boost::beast::flat_buffer heard_;
  boost::asio::steady_timer timer_;
  std::uint64_t next_ = 0;  // number of the next event to be sent
  std::string text_;        // being sent
};

}  // namespace understudy::server
