// A picture, and its file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace understudy::viewer {

struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgb;  // the upper row first
};

// The mean of every 2 x 2 pixels: half as wide and high; both are even.
Image Halve(const Image& big);

// Writes the whole file or none: whoever reads `file` meanwhile finds the one before. Throws
// SetupError with the reason.
void WritePng(const Image& image, const std::filesystem::path& file);

// Throws SetupError when the file is there and may not be overwritten, or its folder is not.
void CheckWritable(const std::filesystem::path& file, bool overwrite);

}  // namespace understudy::viewer
