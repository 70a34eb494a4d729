// A connection that speaks HTTP. Sees Boost; for the server's own files only.
#pragma once

#include <memory>
#include <optional>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/routes.h"

namespace understudy::server {

// Reads a request, waits for the tick if it must, writes the reply, and starts again. One operation
// is pending at any time; the one that finds nothing more to do removes the session from its list.
class Session : public Connection {
 public:
  Session(boost::asio::generic::stream_protocol::socket socket, Connections* connections,
          Shared* shared);

  void Begin() override { Read(); }
  void OnFrame(ShownFrame* shown) override;

  // Writes why there is no room, as much of it as goes without waiting.
  static void RefuseBusy(boost::asio::generic::stream_protocol::socket* socket);

 private:
  std::shared_ptr<Session> Self() { return std::static_pointer_cast<Session>(shared_from_this()); }
  void Read();
  void OnRead(const boost::system::error_code& error);
  void Answer(const HttpRequest& request);
  void AwaitFrame(const FromFrame& wanted);
  void Upgrade(const Routed& routed);
  void Write(HttpReply reply);
  void Write(HttpReply reply, bool keep_alive);
  void Forget();
  void Leave() { connections_->Remove(this); }

  Connections* connections_;
  Shared* shared_;
  Stream stream_;
  boost::beast::flat_buffer buffer_;
  std::optional<boost::beast::http::request_parser<boost::beast::http::string_body>> parser_;
  bool broken_ = false;  // the request: not all of it was read
  HttpReply reply_;
  boost::beast::http::response<boost::beast::http::span_body<const char>> response_;
  boost::asio::steady_timer frame_timer_;
  std::optional<FromFrame> frame_;  // that is awaited
};

}  // namespace understudy::server
