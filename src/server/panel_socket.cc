#include "server/panel_socket.h"

#include <array>
#include <cerrno>
#include <cstdint>
#include <system_error>

#include <arpa/inet.h>
#include <sys/socket.h>
#include <unistd.h>

#include "base/errors.h"
#include "server/access.h"

namespace understudy::server {
namespace {

// An address of either family; the port goes in later.
struct Address {
  sockaddr_storage storage{};
  socklen_t size = 0;
};

Address Parse(const std::string& text) {
  Address address;
  auto* four = reinterpret_cast<sockaddr_in*>(&address.storage);
  auto* six = reinterpret_cast<sockaddr_in6*>(&address.storage);
  if (::inet_pton(AF_INET, text.c_str(), &four->sin_addr) == 1) {
    four->sin_family = AF_INET;
    address.size = sizeof *four;
  } else if (::inet_pton(AF_INET6, text.c_str(), &six->sin6_addr) == 1) {
    six->sin6_family = AF_INET6;
    address.size = sizeof *six;
  } else {
    throw ConfigError("control.address: expected an IP address, as 127.0.0.1 or ::1, got '" + text +
                      "'");
  }
  return address;
}

// Of both families: the port is at the same place.
in_port_t& PortOf(Address* address) {
  return reinterpret_cast<sockaddr_in*>(&address->storage)->sin_port;
}

// A listening socket, or -1 with errno.
int Listen(Address* address, int port) {
  PortOf(address) = htons(static_cast<std::uint16_t>(port));
  const int fd = ::socket(address->storage.ss_family, SOCK_STREAM | SOCK_CLOEXEC, 0);
  if (fd < 0) return -1;
  // Lets a run reuse the port of the previous one while its connections linger.
  const int on = 1;
  ::setsockopt(fd, SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
  const auto* generic = reinterpret_cast<const sockaddr*>(&address->storage);
  if (::bind(fd, generic, address->size) == 0 && ::listen(fd, SOMAXCONN) == 0) return fd;
  const int cause = errno;
  ::close(fd);
  errno = cause;
  return -1;
}

int ListenAtFree(Address* address, int first) {
  for (int port = first; port < first + kPanelPorts; ++port) {
    const int fd = Listen(address, port);
    if (fd >= 0 || errno != EADDRINUSE) return fd;
  }
  return Listen(address, 0);
}

// Normalises an address as the system and browsers write it; IPv6 has many notations.
std::string TextOf(const std::string& address, int family) {
  std::array<unsigned char, sizeof(in6_addr)> bytes{};
  std::array<char, INET6_ADDRSTRLEN> text{};
  ::inet_pton(family, address.c_str(), bytes.data());
  return ::inet_ntop(family, bytes.data(), text.data(), text.size());
}

}  // namespace

PanelSocket::PanelSocket(const std::string& address, int port, int domain) : token_(RandomToken()) {
  Address bound = Parse(address);
  family_ = bound.storage.ss_family;
  address_ = TextOf(address, family_);
  fd_ = port == 0 ? ListenAtFree(&bound, kFirstPanelPort + domain) : Listen(&bound, port);
  if (fd_ < 0) {
    const std::string where =
        "control.address " + address + ", control.port " + std::to_string(port);
    throw SocketError(errno == EADDRINUSE
                          ? where +
                                ": the port is in use; take another, or start without a panel: "
                                "--no-panel"
                          : where + ": " + std::generic_category().message(errno) +
                                "; --no-panel starts without a panel");
  }
  ::getsockname(fd_, reinterpret_cast<sockaddr*>(&bound.storage), &bound.size);
  port_ = ntohs(PortOf(&bound));
}

PanelSocket::~PanelSocket() { ::close(fd_); }

std::string PanelSocket::host() const {
  std::string name = address_;
  if (name == "0.0.0.0") name = "127.0.0.1";
  if (name == "::") name = "::1";
  return (family_ == AF_INET6 ? "[" + name + "]" : name) + ":" + std::to_string(port_);
}

}  // namespace understudy::server
