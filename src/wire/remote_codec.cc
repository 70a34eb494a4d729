#include "wire/remote_codec.h"

#include <bit>
#include <cstring>

namespace understudy::wire {

std::array<std::uint8_t, 40> EncodeRemote(const robot::RemoteReading& remote) {
  static_assert(std::endian::native == std::endian::little);
  constexpr unsigned kL2 = 1U << 5;
  std::array<std::uint8_t, 40> bytes{};
  if (!remote.there) return bytes;
  bytes[0] = 0x55;
  bytes[1] = 0x51;
  std::memcpy(bytes.data() + 2, &remote.keys, sizeof remote.keys);
  const float axes[] = {static_cast<float>(remote.lx), static_cast<float>(remote.rx),
                        static_cast<float>(remote.ry), (remote.keys & kL2) != 0 ? 1.0F : 0.0F,
                        static_cast<float>(remote.ly)};
  std::memcpy(bytes.data() + 4, axes, sizeof axes);
  return bytes;
}

void EncodeRemote(const robot::RemoteReading& remote,
                  unitree_go_msg_dds__WirelessController_* message) {
  message->lx = static_cast<float>(remote.lx);
  message->ly = static_cast<float>(remote.ly);
  message->rx = static_cast<float>(remote.rx);
  message->ry = static_cast<float>(remote.ry);
  message->keys = remote.keys;
}

}  // namespace understudy::wire
