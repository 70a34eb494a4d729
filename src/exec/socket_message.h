// Messages between two processes of ours over a stream socket: a length, then that many bytes.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace understudy::exec {

// Returns false if the other end has gone.
bool SendMessage(int socket, std::string_view message);

// Waits for the next message. Returns nullopt if the other end has gone, and after the socket's
// time-out.
std::optional<std::string> ReceiveMessage(int socket);

}  // namespace understudy::exec
