// Authorizes requests on the TCP socket, which every local program can reach.
#pragma once

#include <optional>
#include <string>

#include "server/http.h"

namespace understudy::server {

// Of the TCP connections. The Unix socket needs none: its file is its user's alone.
struct Access {
  std::string token;    // of this run
  std::string address;  // that it is bound to, as inet_ntop writes it
};

// 128 random bits, hexadecimal. Throws SocketError when the system has none.
std::string RandomToken();

// Why the request is refused, if it is:
//   403  its Host is neither a loopback name nor the bound address: a web page whose name leads
//        here (DNS rebinding). Bound to every address, any address will do, and still no name
//   403  its Origin is not the Host's own: another page in the user's browser
//   401  it writes, or asks for the token, and has none: `Authorization: Bearer TOKEN`, or of a
//        WebSocket, whose header a page cannot fill, also ?token=TOKEN
std::optional<HttpReply> RefusalOf(const HttpRequest& request, const Access& access);

}  // namespace understudy::server
