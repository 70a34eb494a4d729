#include "video/multicast_sender.h"

#include <cerrno>
#include <system_error>

#include <arpa/inet.h>
#include <net/if.h>
#include <netinet/in.h>
#include <sys/socket.h>

#include "base/errors.h"

namespace understudy::video {

MulticastSender::MulticastSender(const std::string& interface, int port)
    : socket_(::socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)) {
  ip_mreqn from{};
  from.imr_ifindex = static_cast<int>(::if_nametoindex(interface.c_str()));
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(port));
  ::inet_pton(AF_INET, kGroup, &to.sin_addr);
  // Connected, so that a packet needs no look for its way.
  if (!socket_.valid() || from.imr_ifindex == 0 ||
      ::setsockopt(socket_.get(), IPPROTO_IP, IP_MULTICAST_IF, &from, sizeof from) != 0 ||
      ::connect(socket_.get(), reinterpret_cast<const sockaddr*>(&to), sizeof to) != 0) {
    throw SetupError("no video stream to " + std::string(kGroup) + " on " + interface + ": " +
                     std::generic_category().message(errno));
  }
}

bool MulticastSender::Send(std::span<const std::uint8_t> packet) const noexcept {
  return ::send(socket_.get(), packet.data(), packet.size(), MSG_NOSIGNAL) ==
         static_cast<ssize_t>(packet.size());
}

}  // namespace understudy::video
