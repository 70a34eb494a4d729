// Renders the scene of a Stage into images and writes image files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "viewer/screen_text.h"
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

class Canvas {
 public:
  // Hard edges have one sample a pixel, smooth ones four. For fine ones it renders at twice the
  // size and averages, at four times the cost.
  enum class Edges : std::uint8_t { kHard, kSmooth, kFine };

  // Needs a current OpenGL context, also in the destructor. Throws SetupError if the context cannot
  // have images of this size.
  Canvas(Stage* stage, const PictureSize& size, Edges edges);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  // Renders the last composed scene, and `caption` over it if there is one: the clock at the upper
  // left, events at the lower left, lines that are too long cut. The reference is valid until the
  // next call.
  const Image& Draw(Stage* stage, const Caption* caption = nullptr);

 private:
  void Write(const Caption& caption);
  std::string Cut(std::string line) const;

  PictureSize drawn_;  // twice the image size if it is averaged
  bool fine_;
  mjrContext context_;
  Image image_, upside_down_;
};

}  // namespace understudy::viewer
