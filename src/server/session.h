// An HTTP connection. Includes Boost; private to server/.
#pragma once

#include <memory>
#include <optional>

#include <boost/asio/steady_timer.hpp>
#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/routes.h"

namespace understudy::server {

// Reads a request, waits for the tick if necessary, writes the reply, and starts again. Exactly one
// operation is pending at any time; the last one removes the session from its list.
class Session : public Connection {
 public:
  Session(boost::asio::generic::stream_protocol::socket socket, Connections* connections,
          Shared* shared);

  void Begin() override { Read(); }
  void GiveWay() override { stream_.close(); }
  void OnSnapshot(ShownSnapshot* shown) override;

  // Writes a 503 reply, as far as possible without waiting.
  static void RefuseBusy(boost::asio::generic::stream_protocol::socket* socket);

 private:
  std::shared_ptr<Session> Self() { return std::static_pointer_cast<Session>(shared_from_this()); }
  void Read();
  void OnRead(const boost::system::error_code& error);
  void Answer(const HttpRequest& request);
  void AwaitSnapshot(const FromSnapshot& wanted);
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
  bool broken_ = false;  // the request was not read completely
  bool known_ = false;   // the client may write
  HttpReply reply_;
  boost::beast::http::response<boost::beast::http::span_body<const char>> response_;
  boost::asio::steady_timer snapshot_timer_;
  std::optional<FromSnapshot> snapshot_;  // the reply that waits for a snapshot
};

}  // namespace understudy::server
