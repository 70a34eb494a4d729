// Sends packets to a multicast group on one interface.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "base/unique_fd.h"

namespace understudy::video {

// Where robots send their streams: the vendor's examples.
inline constexpr char kGroup[] = "230.1.1.1";

// UDP to kGroup. Programs of this machine receive it too; routers pass nothing on.
class MulticastSender {
 public:
  // Throws SetupError with the reason if `interface` does not exist or takes no multicast.
  MulticastSender(const std::string& interface, int port);

  // Never waits. Returns false if the packet has not left.
  bool Send(std::span<const std::uint8_t> packet) const noexcept;

 private:
  UniqueFd socket_;
};

}  // namespace understudy::video
