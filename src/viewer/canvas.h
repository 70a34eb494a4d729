// Renders the scene of a Stage into images and writes image files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
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

// How far what each pixel shows is along the camera's axis.
struct DepthImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint16_t> mm;  // top row first; 0: none
};

// Returns the means of 2 x 2 pixels: half as wide and high. Both must be even.
Image Halve(const Image& big);

// Returns both in one. They are equally high.
Image SideBySide(const Image& left, const Image& right);

// Writes a PNG file, replacing an existing one atomically. Throws SetupError with the reason.
void WritePng(const Image& image, const std::filesystem::path& file);

// Returns the bytes of a PNG file of 16 bits. Throws SetupError.
std::string EncodePng(const DepthImage& image);

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

  // Returns the depths [m] along the camera's axis of what Draw rendered last of that stage, top
  // row first. Edges must be hard. The reference is valid until the next call.
  const std::vector<float>& Depths(Stage* stage);

 private:
  void Write(const Caption& caption);
  std::string Cut(std::string line) const;

  PictureSize drawn_;  // twice the image size if it is averaged
  bool fine_;
  mjrContext context_;
  Image image_, upside_down_;
  std::vector<float> depths_;
};

}  // namespace understudy::viewer
