#include "mjcf/stl.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace understudy::mjcf {
namespace {

constexpr std::size_t kOfTriangle = 9;
constexpr std::size_t kMostOfStl = kOfTriangle * 200'000;  // of a file that MuJoCo reads

}  // namespace

std::string Stl(std::span<const float> corners) {
  std::string bytes(80, '\0');
  const auto add = [&](const void* from, std::size_t size) {
    bytes.append(static_cast<const char*>(from), size);
  };
  static_assert(std::endian::native == std::endian::little);
  const auto faces = static_cast<std::uint32_t>(corners.size() / kOfTriangle);
  add(&faces, sizeof faces);
  for (std::size_t i = 0; i < faces; ++i) {
    const std::array<float, 3> normal{};
    add(normal.data(), sizeof normal);
    add(corners.data() + kOfTriangle * i, kOfTriangle * sizeof(float));
    bytes.append(2, '\0');
  }
  return bytes;
}

std::vector<std::string> Stls(std::span<const float> corners) {
  std::vector<std::string> solids;
  while (!corners.empty()) {
    const std::size_t some = std::min(corners.size(), kMostOfStl);
    solids.push_back(Stl(corners.first(some)));
    corners = corners.subspan(some);
  }
  return solids;
}

}  // namespace understudy::mjcf
