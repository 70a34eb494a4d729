// Authorizes requests on the TCP socket, which every local program can reach.
#pragma once

#include <optional>
#include <string>

#include "server/http.h"

namespace understudy::server {

// The access rules of TCP connections. The Unix socket needs none: only its user can open its file.
struct AccessRules {
  std::string token;    // new in each run
  std::string address;  // the bound address, as inet_ntop writes it
};

// Returns 128 random bits in hexadecimal. Throws SocketError if the system has none.
std::string RandomToken();

// Whether the request has the token: `Authorization: Bearer TOKEN`, or of a WebSocket, whose header
// a page cannot fill, also ?token=TOKEN.
bool HasToken(const HttpRequest& request, const AccessRules& access);

// Why the request is refused, if it is:
//   403  its Host is neither a loopback name nor the bound address: a web page whose name leads
//        here (DNS rebinding). Bound to every address, any address will do, and still no name
//   403  its Origin is not the Host's own: another page in the user's browser
//   401  it writes, asks for the token or for recordings, and has none
std::optional<HttpReply> RefusalOf(const HttpRequest& request, const AccessRules& access);

}  // namespace understudy::server
