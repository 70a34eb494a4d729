#include "robot/remote_keys.h"

#include <algorithm>
#include <cctype>

namespace understudy::robot {
namespace {

bool SameWord(std::string_view one, std::string_view other) {
  return std::equal(one.begin(), one.end(), other.begin(), other.end(), [](char a, char b) {
    return std::toupper(static_cast<unsigned char>(a)) ==
           std::toupper(static_cast<unsigned char>(b));
  });
}

}  // namespace

std::optional<std::uint16_t> RemoteKeys(std::string_view chord) {
  unsigned keys = 0;
  while (true) {
    const std::size_t plus = chord.find('+');
    const std::string_view word = chord.substr(0, plus);
    const auto key = std::find_if(kRemoteKeys.begin(), kRemoteKeys.end(),
                                  [&](std::string_view name) { return SameWord(name, word); });
    if (key == kRemoteKeys.end()) return std::nullopt;
    keys |= 1U << (key - kRemoteKeys.begin());
    if (plus == std::string_view::npos) return static_cast<std::uint16_t>(keys);
    chord.remove_prefix(plus + 1);
  }
}

std::string RemoteKeyNames(std::uint16_t keys) {
  RemoteKeyText room{};
  return std::string(WriteRemoteKeyNames(keys, &room));
}

std::string_view WriteRemoteKeyNames(std::uint16_t keys, RemoteKeyText* room) {
  std::size_t size = 0;
  for (std::size_t bit = 0; bit < kRemoteKeys.size(); ++bit) {
    if ((keys >> bit & 1U) == 0) continue;
    if (size > 0) (*room)[size++] = '+';
    size += kRemoteKeys[bit].copy(room->data() + size, room->size() - size);
  }
  return {room->data(), size};
}

}  // namespace understudy::robot
