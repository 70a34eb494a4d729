// Draws with the OpenGL of this machine, usually Mesa's software renderer.
#include "viewer/canvas.h"

#include <algorithm>
#include <string>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "viewer/camera_operator.h"
#include "viewer/headless_gl.h"
#include "viewer_test.h"

namespace understudy::viewer {
namespace {

struct Pixel {
  int r, g, b;
};

Pixel At(const Image& image, int x, int y) {
  const auto i = 3 * static_cast<std::size_t>(y * image.width + x);
  return {image.rgb[i], image.rgb[i + 1], image.rgb[i + 2]};
}

class CanvasTest : public test::MujocoTest {
 protected:
  Image Draw(double x, Canvas::Edges edges) {
    stage_.Show(BallAt(x));
    mjvCamera camera;
    mjv_defaultCamera(&camera);
    camera.type = mjCAMERA_FIXED;
    camera.fixedcamid = stage_.Camera("above");
    Canvas canvas(&stage_, {.width = 64, .height = 48}, edges);
    stage_.Compose(&camera, {}, nullptr);
    return canvas.Draw(&stage_);
  }

  std::unique_ptr<HeadlessGl> gl_ = MakeHeadlessGl("egl");
  Stage stage_{BallModel()};
};

TEST_F(CanvasTest, DrawsTheRobotWhereItIs) {
  for (const Canvas::Edges edges :
       {Canvas::Edges::kHard, Canvas::Edges::kSmooth, Canvas::Edges::kFine}) {
    const Image middle = Draw(0, edges);
    ASSERT_EQ(middle.width, 64);
    ASSERT_EQ(middle.height, 48);
    ASSERT_EQ(middle.rgb.size(), 3U * 64U * 48U);
    // Beside the arm, which the camera sees end on.
    EXPECT_GT(At(middle, 34, 24).r, 2 * At(middle, 34, 24).b);
    EXPECT_LT(At(middle, 60, 24).r, 2 * At(middle, 60, 24).b) << "the floor";
    const Image right = Draw(4, edges);
    EXPECT_GT(At(right, 47, 24).r, 2 * At(right, 47, 24).b);
    EXPECT_LT(At(right, 32, 24).r, 2 * At(right, 32, 24).b);
  }
}

TEST_F(CanvasTest, HasTheUpperRowFirst) {
  stage_.Show(BallAt(0));
  CameraChoice choice;
  choice.azimuth = 90;
  choice.elevation = 0;
  CameraOperator camera(stage_, choice, {.width = 64, .height = 64});
  Canvas canvas(&stage_, {.width = 64, .height = 64}, Canvas::Edges::kSmooth);
  stage_.Compose(camera.camera(), {}, nullptr);
  const Image image = canvas.Draw(&stage_);
  int green_above = 0;
  int green_below = 0;
  for (int y = 0; y < 64; ++y) {
    const Pixel pixel = At(image, 32, y);
    if (pixel.g > 2 * pixel.r && pixel.g > 2 * pixel.b) ++(y < 32 ? green_above : green_below);
  }
  EXPECT_GT(green_above, green_below) << "the arm is on top of the ball";
}

TEST_F(CanvasTest, WritesClockAndEventsIntoItsCorners) {
  stage_.Show(BallAt(0));
  mjvCamera camera;
  mjv_defaultCamera(&camera);
  camera.type = mjCAMERA_FIXED;
  camera.fixedcamid = stage_.Camera("above");
  Canvas canvas(&stage_, {.width = 320, .height = 180}, Canvas::Edges::kSmooth);
  stage_.Compose(&camera, {}, nullptr);
  const Image plain = canvas.Draw(&stage_);
  const auto changed = [&](const Caption& caption, int from_y, int to_y) {
    const Image image = canvas.Draw(&stage_, &caption);
    int pixels = 0, right = 0;
    for (int y = from_y; y < to_y; ++y) {
      for (int x = 0; x < image.width; ++x) {
        if (At(image, x, y).g == At(plain, x, y).g) continue;
        ++pixels;
        right = std::max(right, x);
      }
    }
    EXPECT_LT(right, 320);
    return pixels;
  };
  const Caption quiet{.clock = "1.00 s", .events = {}};
  const Caption busy{.clock = "1.00 s", .events = {"1.00 s  push", std::string(500, 'w')}};
  EXPECT_GT(changed(quiet, 0, 60), 100);
  EXPECT_EQ(changed(quiet, 60, 180), 0);
  EXPECT_GT(changed(busy, 120, 180), 500);
  EXPECT_EQ(changed(busy, 60, 120), 0);
}

TEST(HeadlessGlTest, SaysWhatToInstallWhereThereIsNone) {
  EXPECT_THAT([] { MakeHeadlessGl("vulkan"); },
              testing::ThrowsMessage<SetupError>(testing::HasSubstr("apt-get install libegl1")));
}

}  // namespace
}  // namespace understudy::viewer
