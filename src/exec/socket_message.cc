#include "exec/socket_message.h"

#include <cerrno>
#include <cstdint>

#include <sys/socket.h>

namespace understudy::exec {
namespace {

constexpr std::uint32_t kMostBytes = 64U << 20U;  // more is no message of ours

bool Send(int socket, const char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t sent = ::send(socket, bytes, count, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    bytes += sent;
    count -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool Receive(int socket, char* bytes, std::size_t count) {
  while (count > 0) {
    const ssize_t got = ::recv(socket, bytes, count, 0);
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) return false;
    bytes += got;
    count -= static_cast<std::size_t>(got);
  }
  return true;
}

}  // namespace

bool SendMessage(int socket, std::string_view message) {
  const auto size = static_cast<std::uint32_t>(message.size());
  return Send(socket, reinterpret_cast<const char*>(&size), sizeof size) &&
         Send(socket, message.data(), message.size());
}

std::optional<std::string> ReceiveMessage(int socket) {
  std::uint32_t size = 0;
  if (!Receive(socket, reinterpret_cast<char*>(&size), sizeof size)) return std::nullopt;
  if (size > kMostBytes) return std::nullopt;
  std::string message(size, '\0');
  if (!Receive(socket, message.data(), size)) return std::nullopt;
  return message;
}

}  // namespace understudy::exec
