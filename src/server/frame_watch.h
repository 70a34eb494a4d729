// A WebSocket on which frames are sent. Sees Boost; for the server's own files only.
#pragma once

#include <chrono>
#include <memory>
#include <string>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/routes.h"
#include "server/web_socket.h"

namespace understudy::server {

// Asks for a frame, sends it, and asks for the next when that is gone and its time has come: a slow
// client gets fewer, and none waits for it here. What the client sends is read and left aside.
class FrameWatch : public Connection {
 public:
  using Request = boost::beast::http::request<boost::beast::http::string_body>;

  FrameWatch(Stream stream, Request request, const WatchFrames& wanted, Connections* connections,
             Shared* shared);

  void Begin() override;
  void OnFrame(ShownFrame* shown) override;

 private:
  using Clock = std::chrono::steady_clock;

  std::shared_ptr<FrameWatch> Self() {
    return std::static_pointer_cast<FrameWatch>(shared_from_this());
  }
  void Listen();
  void Next();
  void Leave();

  Request request_;
  emulator::FrameParts parts_;
  Clock::duration period_;
  Connections* connections_;
  Shared* shared_;
  WebSocket stream_;
  boost::beast::flat_buffer heard_;
  boost::asio::steady_timer timer_;
  Clock::time_point due_;
  std::shared_ptr<const std::string> text_;  // being sent
};

}  // namespace understudy::server
