// Renders the scene of a Stage into images and writes image files.
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
  std::vector<std::uint8_t> rgb;  // top row first
};

// Returns the means of 2 x 2 pixels: half as wide and high. Both must be even.
Image Halve(const Image& big);

// Writes a PNG file, replacing an existing one atomically. Throws SetupError with the reason.
void WritePng(const Image& image, const std::filesystem::path& file);

// Throws SetupError if the file exists and `overwrite` is false, or if its folder does not exist.
void CheckWritable(const std::filesystem::path& file, bool overwrite);

class Canvas {
 public:
  // Needs a current OpenGL context, also in the destructor. `fine` renders at twice the size and
  // averages: smoother edges at four times the cost. Throws SetupError if the context cannot have
  // images of this size.
  Canvas(Stage* stage, const PictureSize& size, bool fine);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Renders the last composed scene. The reference is valid until the next call.
  const Image& Draw(Stage* stage);

 private:
  PictureSize drawn_;  // twice the image size if it is averaged
  bool fine_;
  mjrContext context_;
  Image image_, upside_down_;
};

}  // namespace understudy::viewer
