#include "mjcf/mesh_file.h"

#include <algorithm>
#include <cctype>
#include <cstdint>
#include <cstring>

#include "base/errors.h"
#include "mjcf/dae.h"
#include "mjcf/mesh_builder.h"

namespace understudy::mjcf {
namespace {

struct Format {
  std::string_view extension;
  std::vector<MeshPart> (*read)(const std::filesystem::path& file);
};

constexpr Format kFormats[] = {
    {".dae", ReadDae}, {".obj", ReadObj}, {".ply", ReadPly}, {".stl", ReadStl}};

const Format* FormatOf(const std::filesystem::path& file) {
  std::string extension = file.extension();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  const auto* const found = std::ranges::find(kFormats, extension, &Format::extension);
  return found == std::end(kFormats) ? nullptr : found;
}

// 80 bytes of anything, the number of triangles, and 50 bytes for each: its normal, corners and two
// more.
constexpr std::size_t kStlHead = 84;
constexpr std::size_t kStlTriangle = 50;

std::vector<MeshPart> ReadBinaryStl(const std::string& file, const std::string& bytes) {
  MeshBuilder parts(file);
  for (std::size_t at = kStlHead; at < bytes.size(); at += kStlTriangle) {
    std::array<float, 12> numbers{};
    std::memcpy(numbers.data(), bytes.data() + at, sizeof numbers);
    const auto corner = [&](std::size_t i) {
      return MeshPoint{numbers[3 * i], numbers[3 * i + 1], numbers[3 * i + 2]};
    };
    parts.Add(std::nullopt, corner(1), corner(2), corner(3));
  }
  return parts.Take();
}

}  // namespace

std::vector<std::string_view> MeshExtensions() {
  std::vector<std::string_view> extensions;
  for (const Format& format : kFormats) extensions.push_back(format.extension);
  return extensions;
}

bool IsMeshFile(const std::filesystem::path& file) { return FormatOf(file) != nullptr; }

std::vector<MeshPart> ReadMeshFile(const std::filesystem::path& file) {
  const Format* const format = FormatOf(file);
  if (format != nullptr) return format->read(file);
  std::string all;
  for (const Format& one : kFormats) all += (all.empty() ? "" : ", ") + std::string(one.extension);
  throw ModelError(file.string() + ": expected one of " + all);
}

std::vector<MeshPart> ReadStl(const std::filesystem::path& file) {
  const std::string bytes = MeshBytes(file);
  std::uint32_t count = 0;
  if (bytes.size() >= kStlHead) std::memcpy(&count, bytes.data() + kStlHead - sizeof count, 4);
  // Binary ones may begin with "solid" as well.
  if (bytes.size() == kStlHead + kStlTriangle * count && count > 0) {
    return ReadBinaryStl(file.string(), bytes);
  }
  if (!bytes.starts_with("solid")) {
    throw ModelError(file.string() + ": expected STL, as text or with the bytes of " +
                     std::to_string(count) + " triangles");
  }
  MeshText text(file.string(), bytes);
  MeshBuilder parts(file.string());
  std::vector<MeshPoint> corners;
  while (text.NextLine()) {
    if (text.Word() != "vertex") continue;
    corners.push_back({text.Number(), text.Number(), text.Number()});
    if (corners.size() < 3) continue;
    parts.Add(std::nullopt, corners[0], corners[1], corners[2]);
    corners.clear();
  }
  return parts.Take();
}

}  // namespace understudy::mjcf
