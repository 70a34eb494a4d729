#include "viewer/canvas.h"

#include <algorithm>

#include <mujoco/mujoco.h>

#include "base/errors.h"

namespace understudy::viewer {
namespace {

constexpr int kSamples = 4;          // per pixel; what every OpenGL has
constexpr int kShadowPixels = 2048;  // *assumed*: 1 mm each about a robot

}  // namespace

Canvas::Canvas(Stage* stage, const PictureSize& size, bool fine) : drawn_(size), fine_(fine) {
  if (fine_) drawn_ = {.width = 2 * size.width, .height = 2 * size.height};
  mjVisual* visual = stage->visual();
  visual->global.offwidth = drawn_.width;
  visual->global.offheight = drawn_.height;
  visual->quality.offsamples = kSamples;
  visual->quality.shadowsize = kShadowPixels;
  mjr_defaultContext(&context_);
  mjr_makeContext(&stage->model(), &context_, mjFONTSCALE_100);
  mjr_setBuffer(mjFB_OFFSCREEN, &context_);
  if (context_.currentBuffer != mjFB_OFFSCREEN) {
    mjr_freeContext(&context_);
    throw SetupError("this OpenGL draws into windows only");
  }
}

Canvas::~Canvas() { mjr_freeContext(&context_); }

const Image& Canvas::Draw(Stage* stage) {
  const mjrRect whole{0, 0, drawn_.width, drawn_.height};
  const std::size_t row = 3 * static_cast<std::size_t>(drawn_.width);
  context_.shadowClip = static_cast<float>(stage->shadow_reach());
  mjr_render(whole, stage->scene(), &context_);

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

}  // namespace understudy::viewer
