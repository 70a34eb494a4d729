// The WebSockets of the server: snapshots, events, requests. Includes Boost; private to server/.
#pragma once

#include <memory>

#include <boost/beast/http.hpp>

#include "server/connection.h"
#include "server/routes.h"

namespace understudy::server {

using Handshake = boost::beast::http::request<boost::beast::http::string_body>;

// What `routed` asks for, one of:
//   WatchSnapshots  asks for a snapshot, sends it, and asks for the next when that is gone and its
//                   time has come: a slow client gets fewer, and none waits for it here
//   WatchEvents     sends each event of the history, and then each as it comes, one message each
//   TakeRequests    each message {"crane.lower": {"by": 0.1}, "id": text or number} is a request
//                   with its values, and answered by {"id": the same, "status": n} with the fields
//                   of the POST's reply. The next is not read before, unless it waits for its steps
// What a client sends on the first two is read and left aside.
std::shared_ptr<Connection> MakeWebSocket(Stream stream, Handshake handshake, const Routed& routed,
                                          Connections* connections, Shared* shared);

}  // namespace understudy::server
