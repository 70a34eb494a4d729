#include "video/readers.h"

#include <array>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <sstream>

#include <arpa/inet.h>

#include "video/multicast_sender.h"

namespace understudy::video {
namespace {

std::string TextOf(const std::filesystem::path& file) {
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

std::string Hex(std::uint32_t number, int digits) {
  std::array<char, 9> text{};
  std::snprintf(text.data(), text.size(), "%0*X", digits, number);
  return text.data();
}

}  // namespace

// A line `1 lo : 2 V3` for each interface, then an indented one for each of its groups, whose four
// bytes are printed as a number of this machine.
bool HasJoined(std::string_view igmp, std::string_view interface, const std::string& group) {
  in_addr address{};
  if (::inet_pton(AF_INET, group.c_str(), &address) != 1) return false;
  const std::string wanted = Hex(address.s_addr, 8);
  std::istringstream lines{std::string(igmp)};
  bool here = false;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first, second;
    words >> first >> second;
    if (!line.starts_with('\t')) {
      if (second.ends_with(':')) second.pop_back();  // of a name of ten letters or more
      here = second == interface;
    } else if (here && first == wanted) {
      return true;
    }
  }
  return false;
}

// Lines `13: 010101E6:06B8 00000000:0000 07 ...`: number, local address and port, the other end's.
bool IsOpen(std::string_view udp, int port) {
  const std::string ending = ":" + Hex(static_cast<std::uint32_t>(port), 4);
  std::istringstream lines{std::string(udp)};
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string number, local;
    words >> number >> local;
    if (local.ends_with(ending)) return true;
  }
  return false;
}

bool IsRead(const std::string& interface, int port, const std::filesystem::path& net) {
  return HasJoined(TextOf(net / "igmp"), interface, kGroup) && IsOpen(TextOf(net / "udp"), port);
}

}  // namespace understudy::video
