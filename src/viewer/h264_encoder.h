// Packs pictures as a video stream.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "viewer/canvas.h"

struct x264_t;

namespace understudy::viewer {

// H.264 as a robot's camera sends it: High profile, one frame out for each picture in, 1.69 Mbit/s.
class H264Encoder {
 public:
  static constexpr int kMostWidth = 1280;    // pixels; wider pictures are scaled down to it
  static constexpr double kKeyPeriod = 2.0;  // s between frames at which a reader may join

  // Of pictures of that size, so many a second. Throws SetupError.
  H264Encoder(const PictureSize& size, double hz);
  ~H264Encoder();
  H264Encoder(const H264Encoder&) = delete;
  H264Encoder& operator=(const H264Encoder&) = delete;

  // Returns the picture's frame: NAL units behind start codes (Annex B). `time` in s is when it was
  // taken. The first, and each after kKeyPeriod or a step back in time, stands for itself, behind
  // its parameter sets. The image has the size of the constructor. Throws SetupError.
  std::string Encode(const Image& image, double time);

  const PictureSize& size() const { return size_; }  // of the video

 private:
  void Convert(const Image& image);

  PictureSize size_;
  x264_t* encoder_ = nullptr;
  std::vector<std::uint8_t> luma_, blue_, red_;
  std::int64_t frames_ = 0;
  double last_ = 0, key_ = 0;  // s: of the last frame, and of the last that stands for itself
};

// Returns a picture of that size, each pixel between the four nearest of the bigger one.
Image Shrink(const Image& big, const PictureSize& size);

}  // namespace understudy::viewer
