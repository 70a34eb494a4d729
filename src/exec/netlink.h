// Requests of rtnetlink(7): the kernel's table of interfaces and addresses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>

#include <linux/rtnetlink.h>

namespace understudy::exec {

// What the kernel says to a request: an NLMSG_ERROR, or what was asked for.
struct NetlinkAnswer {
  // 0, or why a request with NLM_F_ACK was refused, an errno.
  int Error() const;

  nlmsghdr header;
  union {
    nlmsgerr error;        // with NLMSG_ERROR
    std::byte rest[8192];  // otherwise: a header by type, and attributes
  };
  std::size_t size;  // of what was received, bytes
};

// A request and its attributes, which are added one by one.
class NetlinkRequest {
 public:
  // `header` is the one of the type, such as ifinfomsg of RTM_NEWLINK.
  template <class Header>
  NetlinkRequest(std::uint16_t type, int flags, const Header& header) {
    header_.nlmsg_len = NLMSG_LENGTH(0);
    header_.nlmsg_type = type;
    header_.nlmsg_flags = static_cast<std::uint16_t>(NLM_F_REQUEST | flags);
    AddHeader(header);
  }

  template <class Header>
  void AddHeader(const Header& header) {
    std::memcpy(At(header_.nlmsg_len), &header, sizeof(header));
    header_.nlmsg_len += static_cast<std::uint32_t>(NLMSG_ALIGN(sizeof(header)));
  }
  void Add(std::uint16_t type, const void* value, std::size_t size);
  void Add(std::uint16_t type, const std::string& text) {
    Add(type, text.c_str(), text.size() + 1);
  }

  // What is added until Close(), which takes the result, is part of this attribute.
  std::uint32_t Open(std::uint16_t type);
  void Close(std::uint32_t begin);

  // Returns the kernel's answer; an NLMSG_ERROR with the negative errno also if it cannot be asked.
  NetlinkAnswer Send();

 private:
  std::byte* At(std::size_t offset) { return bytes_.data() + offset; }

  nlmsghdr header_{};
  std::array<std::byte, 256> bytes_{};  // twice what a cable takes
};

}  // namespace understudy::exec
