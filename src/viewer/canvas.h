// Draws what a Stage has composed into pictures, in memory and in files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "viewer/stage.h"

namespace understudy::viewer {

// A picture.
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

class Canvas {
 public:
  // Needs a current OpenGL context, also at its end. `fine` draws at twice the size and averages:
  // better edges, four times the work. Throws SetupError when the context cannot have such a
  // picture.
  Canvas(Stage* stage, const PictureSize& size, bool fine);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // What the stage has composed last. The reference holds until the next call.
  const Image& Draw(Stage* stage);

 private:
  PictureSize drawn_;  // twice the picture where it is averaged
  bool fine_;
  mjrContext context_;
  Image image_, upside_down_;
};

}  // namespace understudy::viewer
