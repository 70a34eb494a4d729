#include "viewer/canvas.h"

#include <algorithm>
#include <system_error>

#include <mujoco/mujoco.h>
#include <png.h>
#include <unistd.h>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

constexpr int kSamples = 4;          // per pixel; what every OpenGL has
constexpr int kShadowPixels = 2048;  // *assumed*: 1 mm each about a robot

// So that four lines of events take about a fifth of the picture's height; in small pictures, for
// which there is no smaller font, a third.
mjtFontScale FontScale(int height) {
  struct Row {
    int below;  // pixels
    mjtFontScale scale;
  };
  constexpr Row kRows[] = {
      {600, mjFONTSCALE_100}, {1000, mjFONTSCALE_150}, {1400, mjFONTSCALE_200}};
  for (const Row& row : kRows) {
    if (height < row.below) return row.scale;
  }
  return mjFONTSCALE_300;
}

}  // namespace

Canvas::Canvas(Stage* stage, const PictureSize& size, Edges edges)
    : drawn_(size), fine_(edges == Edges::kFine) {
  if (fine_) drawn_ = {.width = 2 * size.width, .height = 2 * size.height};
  mjVisual* visual = stage->visual();
  visual->global.offwidth = drawn_.width;
  visual->global.offheight = drawn_.height;
  visual->quality.offsamples = edges == Edges::kHard ? 0 : kSamples;
  visual->quality.shadowsize = kShadowPixels;
  mjr_defaultContext(&context_);
  mjr_makeContext(&stage->model(), &context_, FontScale(size.height));
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  if (context_.currentBuffer != mjFB_OFFSCREEN) {
    mjr_freeContext(&context_);
    throw SetupError("this OpenGL draws into windows only");
  }
}

Canvas::~Canvas() { mjr_freeContext(&context_); }

// Within the picture's width, with room for a margin.
std::string Canvas::Cut(std::string line) const {
  line = InFontsLetters(line);
  int left = drawn_.width - 4 * context_.charHeight;
  for (std::size_t i = 0; i < line.size(); ++i) {
    left -= context_.charWidth[static_cast<unsigned char>(line[i])];
    if (left < 0) return line.substr(0, i) + "...";
  }
  return line;
}

void Canvas::Write(const Caption& caption) {
  const mjrRect whole{0, 0, drawn_.width, drawn_.height};
  mjr_overlay(mjFONT_NORMAL, mjGRID_TOPLEFT, whole, Cut(caption.clock).c_str(), nullptr, &context_);
  std::string lines;
  for (const std::string& event : caption.events) lines += (lines.empty() ? "" : "\n") + Cut(event);
  if (lines.empty()) return;
  mjr_overlay(mjFONT_NORMAL, mjGRID_BOTTOMLEFT, whole, lines.c_str(), nullptr, &context_);
}

const Image& Canvas::Draw(Stage* stage, const Caption* caption) {
  const mjrRect whole{0, 0, drawn_.width, drawn_.height};
  const std::size_t row = 3 * static_cast<std::size_t>(drawn_.width);
  context_.shadowClip = static_cast<float>(stage->shadow_reach());
  mjr_render(whole, stage->scene(), &context_);
  if (caption != nullptr) Write(*caption);

  upside_down_.rgb.resize(row * static_cast<std::size_t>(drawn_.height));
  mjr_readPixels(upside_down_.rgb.data(), nullptr, whole, &context_);
  image_.width = drawn_.width;
  image_.height = drawn_.height;
  image_.rgb.resize(upside_down_.rgb.size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(drawn_.height); ++i) {
    const std::uint8_t* from =
        upside_down_.rgb.data() + (static_cast<std::size_t>(drawn_.height) - 1 - i) * row;
    std::copy_n(from, row, image_.rgb.data() + i * row);
  }
  if (fine_) image_ = Halve(image_);
  return image_;
}

const std::vector<float>& Canvas::Depths(Stage* stage) {
  const std::ptrdiff_t width = drawn_.width, height = drawn_.height;
  depths_.resize(static_cast<std::size_t>(width * height));
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  mjr_readPixels(nullptr, depths_.data(), {0, 0, drawn_.width, drawn_.height}, &context_);
  for (std::ptrdiff_t top = 0, bottom = height - 1; top < bottom; ++top, --bottom) {
    std::swap_ranges(depths_.begin() + top * width, depths_.begin() + (top + 1) * width,
                     depths_.begin() + bottom * width);
  }
  // OpenGL's depth is 0 at the near plane and 1 at the far one, evenly in the inverse of the
  // length.
  const float nearest = stage->scene()->camera[0].frustum_near;
  const float farthest = stage->scene()->camera[0].frustum_far;
  for (float& depth : depths_) {
    depth = nearest * farthest / (farthest - depth * (farthest - nearest));
  }
  return depths_;
}

Image Halve(const Image& big) {
  Image half{.width = big.width / 2, .height = big.height / 2, .rgb = {}};
  half.rgb.resize(3 * static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  const std::size_t stride = 3 * static_cast<std::size_t>(big.width);
  std::uint8_t* out = half.rgb.data();
  for (int row = 0; row < half.height; ++row) {
    const std::uint8_t* in = big.rgb.data() + 2 * static_cast<std::size_t>(row) * stride;
    for (int column = 0; column < half.width; ++column, in += 6) {
      for (int c = 0; c < 3; ++c) {
        const int sum = in[c] + in[c + 3] + in[stride + static_cast<std::size_t>(c)] +
                        in[stride + static_cast<std::size_t>(c) + 3];
        *out++ = static_cast<std::uint8_t>((sum + 2) / 4);
      }
    }
  }
  return half;
}

std::string EncodePng(const DepthImage& image) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_LINEAR_Y;
  png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(png);
  std::string bytes(size, '\0');
  if (png_image_write_to_memory(&png, bytes.data(), &size, 0, image.mm.data(), 0, nullptr) == 0) {
    throw SetupError("no PNG: " + std::string(png.message));
  }
  bytes.resize(size);
  return bytes;
}

Image SideBySide(const Image& left, const Image& right) {
  Image both{.width = left.width + right.width, .height = left.height, .rgb = {}};
  both.rgb.reserve(left.rgb.size() + right.rgb.size());
  for (std::ptrdiff_t row = 0; row < both.height; ++row) {
    for (const Image* half : {&left, &right}) {
      const std::ptrdiff_t bytes = std::ptrdiff_t{3} * half->width;
      const auto begin = half->rgb.begin() + row * bytes;
      both.rgb.insert(both.rgb.end(), begin, begin + bytes);
    }
  }
  return both;
}

void WritePng(const Image& image, const std::filesystem::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.width);
  png.height = static_cast<png_uint_32>(image.height);
  png.format = PNG_FORMAT_RGB;
  const std::string part = file.string() + "." + std::to_string(::getpid()) + ".part";
  std::error_code error;
  if (png_image_write_to_file(&png, part.c_str(), 0, image.rgb.data(), 0, nullptr) == 0) {
    std::filesystem::remove(part, error);
    throw SetupError("cannot write " + file.string() + ": " + png.message);
  }
  std::filesystem::rename(part, file, error);
  if (!error) return;
  std::error_code ignored;
  std::filesystem::remove(part, ignored);
  throw SetupError("cannot write " + file.string() + ": " + error.message());
}

}  // namespace understudy::viewer
