// What the server's WebSockets have in common. Sees Boost; for the server's own files only.
#pragma once

#include <boost/beast/websocket.hpp>

#include "server/connection.h"

namespace understudy::server {

// Without compression, which nobody asks for here and which takes long to compile.
using WebSocket = boost::beast::websocket::stream<Stream, false>;

// Limits of time and size: a client that neither reads nor answers pings is hung up on.
inline void Limit(const ServerLimits& limits, WebSocket* socket) {
  using boost::beast::websocket::stream_base;
  socket->set_option(stream_base::timeout{
      .handshake_timeout = limits.idle, .idle_timeout = limits.idle, .keep_alive_pings = true});
  socket->read_message_max(limits.body_bytes);
  socket->auto_fragment(false);
}

// Whatever is under way on it ends with an error.
inline void HangUp(WebSocket* socket) {
  boost::system::error_code ignored;
  boost::beast::get_lowest_layer(*socket).socket().close(ignored);
}

}  // namespace understudy::server
