#include "viewer/h264_encoder.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <x264.h>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

constexpr int kKilobits = 1690;  // per second; measured: a Go2
constexpr int kBurstKilobits =
    845;                         // *assumed*: a frame that stands for itself fits a reader's queue
constexpr int kTimeBase = 1000;  // frames' rates are whole thousandths

PictureSize VideoSize(const PictureSize& picture) {
  PictureSize size = picture;
  if (size.width > H264Encoder::kMostWidth) {
    size.width = H264Encoder::kMostWidth;
    size.height = static_cast<int>(
        std::lround(static_cast<double>(picture.height) * size.width / picture.width));
  }
  // Colours have half of the resolution.
  return {.width = size.width & ~1, .height = size.height & ~1};
}

x264_param_t Settings(const PictureSize& size, double hz) {
  x264_param_t settings;
  x264_param_default_preset(&settings, "ultrafast", "zerolatency");
  settings.i_log_level = X264_LOG_NONE;
  settings.i_threads = 1;
  settings.i_width = size.width;
  settings.i_height = size.height;
  settings.i_csp = X264_CSP_I420;
  settings.i_fps_num = static_cast<std::uint32_t>(std::lround(hz * kTimeBase));
  settings.i_fps_den = kTimeBase;
  settings.b_vfr_input = 0;
  settings.i_keyint_max = X264_KEYINT_MAX_INFINITE;  // Encode decides
  settings.i_scenecut_threshold = 0;
  settings.b_repeat_headers = 1;
  settings.b_annexb = 1;
  settings.rc.i_rc_method = X264_RC_ABR;
  settings.rc.i_bitrate = settings.rc.i_vbv_max_bitrate = kKilobits;
  settings.rc.i_vbv_buffer_size = kBurstKilobits;
  // What makes it High, as a robot's is.
  settings.b_cabac = 1;
  settings.analyse.b_transform_8x8 = 1;
  settings.vui.i_colorprim = settings.vui.i_transfer = settings.vui.i_colmatrix = 1;  // BT.709
  settings.vui.b_fullrange = 0;
  x264_param_apply_profile(&settings, "high");
  return settings;
}

// BT.709 in 1/65536: the share of red, green and blue, from 0 to 255, in values from 16 to 235 or
// 240.
constexpr int kLuma[3] = {11966, 40254, 4064};
constexpr int kBlue[3] = {-6596, -22189, 28784};
constexpr int kRed[3] = {28784, -26145, -2639};

int Mix(const int (&shares)[3], int red, int green, int blue) {
  return shares[0] * red + shares[1] * green + shares[2] * blue;
}

}  // namespace

Image Shrink(const Image& big, const PictureSize& size) {
  Image small{.width = size.width, .height = size.height, .rgb = {}};
  small.rgb.reserve(3 * static_cast<std::size_t>(size.width) *
                    static_cast<std::size_t>(size.height));
  // Of the small picture's pixel: the first of two neighbours, and how far beyond it, in 1/256.
  const auto source = [](int i, int small_count, int big_count) {
    const double place =
        std::clamp((i + 0.5) * big_count / small_count - 0.5, 0.0, big_count - 1 - 1.0 / 256);
    return static_cast<int>(256 * place);
  };
  for (int v = 0; v < size.height; ++v) {
    const int y = source(v, size.height, big.height);
    for (int u = 0; u < size.width; ++u) {
      const int x = source(u, size.width, big.width);
      const std::uint8_t* in =
          big.rgb.data() + 3 * (static_cast<std::ptrdiff_t>(y / 256) * big.width + x / 256);
      const std::uint8_t* below = in + std::ptrdiff_t{3} * big.width;
      for (int c = 0; c < 3; ++c, ++in, ++below) {
        const int upper = in[0] * (256 - x % 256) + in[3] * (x % 256);
        const int lower = below[0] * (256 - x % 256) + below[3] * (x % 256);
        small.rgb.push_back(
            static_cast<std::uint8_t>((upper * (256 - y % 256) + lower * (y % 256) + 32768) >> 16));
      }
    }
  }
  return small;
}

H264Encoder::H264Encoder(const PictureSize& size, double hz) : size_(VideoSize(size)) {
  const auto pixels =
      static_cast<std::size_t>(size_.width) * static_cast<std::size_t>(size_.height);
  luma_.resize(pixels);
  blue_.resize(pixels / 4);
  red_.resize(pixels / 4);
  x264_param_t settings = Settings(size_, hz);
  encoder_ = x264_encoder_open(&settings);
  if (encoder_ == nullptr) throw SetupError("no H.264: libx264 does not take its settings");
}

H264Encoder::~H264Encoder() { x264_encoder_close(encoder_); }

std::string H264Encoder::Encode(const Image& image, double time) {
  if (image.width > kMostWidth) {
    Convert(Shrink(image, size_));
  } else {
    Convert(image);
  }
  const bool key = frames_ == 0 || time < last_ || time - key_ >= kKeyPeriod;
  last_ = time;
  if (key) key_ = time;
  x264_picture_t picture, coded;
  x264_picture_init(&picture);
  picture.i_type = key ? X264_TYPE_IDR : X264_TYPE_AUTO;
  picture.i_pts = frames_++;
  picture.img.i_csp = X264_CSP_I420;
  picture.img.i_plane = 3;
  int plane = 0;
  for (std::vector<std::uint8_t>* values : {&luma_, &blue_, &red_}) {
    picture.img.plane[plane] = values->data();
    picture.img.i_stride[plane] = plane == 0 ? size_.width : size_.width / 2;
    ++plane;
  }
  x264_nal_t* units = nullptr;
  int count = 0;
  const int bytes = x264_encoder_encode(encoder_, &units, &count, &picture, &coded);
  if (bytes <= 0) throw SetupError("no H.264: libx264 gives no frame");
  // libx264 lays the units one behind the other.
  return {reinterpret_cast<const char*>(units[0].p_payload), static_cast<std::size_t>(bytes)};
}

// Two rows at a time: a colour is the mean of four pixels.
void H264Encoder::Convert(const Image& image) {
  constexpr int kHalf = 1 << 15;
  const auto width = static_cast<std::size_t>(size_.width);
  const auto stride = 3 * static_cast<std::size_t>(image.width);
  for (std::size_t v = 0; v < static_cast<std::size_t>(size_.height); v += 2) {
    const std::uint8_t* rows[2] = {image.rgb.data() + v * stride,
                                   image.rgb.data() + (v + 1) * stride};
    for (std::size_t u = 0; u < width; u += 2) {
      int red = 0, green = 0, blue = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        const std::uint8_t* in = rows[i / 2] + 3 * (u + i % 2);
        red += in[0];
        green += in[1];
        blue += in[2];
        luma_[(v + i / 2) * width + u + i % 2] =
            static_cast<std::uint8_t>(16 + ((Mix(kLuma, in[0], in[1], in[2]) + kHalf) >> 16));
      }
      const std::size_t colour = v / 2 * (width / 2) + u / 2;
      blue_[colour] =
          static_cast<std::uint8_t>(128 + ((Mix(kBlue, red, green, blue) / 4 + kHalf) >> 16));
      red_[colour] =
          static_cast<std::uint8_t>(128 + ((Mix(kRed, red, green, blue) / 4 + kHalf) >> 16));
    }
  }
}

}  // namespace understudy::viewer
