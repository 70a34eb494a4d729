// Reads and writes grey pictures, which are heights.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace understudy::terrain {

// Rows from the top, each from the left; 0 is black, 1 white.
struct GreyImage {
  int width = 0, height = 0;
  std::vector<double> grey;
};

// Reads a grey PNG of 1 to 16 bits (alpha is ignored, gamma not applied) or a PGM, plain or raw.
// Throws ModelError that names the file when it is missing, neither of these, coloured, damaged or
// cut short, or not of 2 to 2000 pixels on each side.
GreyImage ReadGreyImage(const std::filesystem::path& file);

// Writes a 16 bit grey PNG, rows from the top. Throws ModelError.
void WriteGreyPng(const std::filesystem::path& file, int width, int height,
                  const std::vector<std::uint16_t>& grey);

}  // namespace understudy::terrain
