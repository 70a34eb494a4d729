// Reads and writes grey images that represent heights.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace understudy::terrain {

// A grey image. `grey` has rows from the top, each from the left; 0 is black, 1 white.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<double> grey;
};

// Reads a grey PNG of 1 to 16 bits (ignoring alpha and gamma) or a plain or raw PGM. Throws
// ModelError with the file's name if it is missing, neither of these, coloured, damaged or
// truncated, or not 2 to 2000 pixels on each side.
GreyImage ReadGreyImage(const std::filesystem::path& file);

// Writes a 16-bit grey PNG, rows from the top. Throws ModelError if it cannot be written.
void WriteGreyPng(const std::filesystem::path& file, int width, int height,
                  const std::vector<std::uint16_t>& grey);

}  // namespace understudy::terrain
