#include "exec/netlink.h"

#include <algorithm>
#include <cerrno>

#include <sys/socket.h>

#include "base/unique_fd.h"

namespace understudy::exec {

int NetlinkAnswer::Error() const {
  return header.nlmsg_type == NLMSG_ERROR ? -error.error : EPROTO;
}

void NetlinkRequest::Add(std::uint16_t type, const void* value, std::size_t size) {
  const std::uint32_t begin = Open(type);
  std::memcpy(At(header_.nlmsg_len), value, size);
  header_.nlmsg_len += static_cast<std::uint32_t>(size);
  Close(begin);
  header_.nlmsg_len = NLMSG_ALIGN(header_.nlmsg_len);
}

std::uint32_t NetlinkRequest::Open(std::uint16_t type) {
  const std::uint32_t begin = header_.nlmsg_len;
  const rtattr attribute{.rta_len = 0, .rta_type = type};
  std::memcpy(At(begin), &attribute, sizeof(attribute));
  header_.nlmsg_len += static_cast<std::uint32_t>(RTA_LENGTH(0));
  return begin;
}

void NetlinkRequest::Close(std::uint32_t begin) {
  const auto size = static_cast<std::uint16_t>(header_.nlmsg_len - begin);
  std::memcpy(At(begin + offsetof(rtattr, rta_len)), &size, sizeof(size));
}

NetlinkAnswer NetlinkRequest::Send() {
  NetlinkAnswer answer{};
  answer.header.nlmsg_type = NLMSG_ERROR;
  const UniqueFd socket(::socket(AF_NETLINK, SOCK_RAW | SOCK_CLOEXEC, NETLINK_ROUTE));
  std::memcpy(bytes_.data(), &header_, sizeof(header_));
  ssize_t got = -1;
  if (socket.valid() && ::send(socket.get(), bytes_.data(), header_.nlmsg_len, 0) >= 0) {
    do {
      got = ::recv(socket.get(), &answer, offsetof(NetlinkAnswer, size), 0);
    } while (got < 0 && errno == EINTR);
  }
  if (got < 0) answer.error.error = -errno;
  answer.size = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
  return answer;
}

}  // namespace understudy::exec
