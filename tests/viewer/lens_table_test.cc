#include "viewer/lens_table.h"

#include <cmath>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "robot/lens.h"

namespace understudy::viewer {
namespace {

robot::CameraSpec Camera() {
  robot::CameraSpec camera;
  camera.width = 320;
  camera.height = 180;
  camera.focal = {216, 216};
  camera.centre = {160, 93};
  camera.distortion = {-0.3546, 0.1021, -0.0016, -0.0012};
  return camera;
}

// A straight picture whose red grows to the right and whose green grows downwards.
Image Slopes(const PictureSize& size) {
  Image image{.width = size.width, .height = size.height, .rgb = {}};
  for (int y = 0; y < size.height; ++y) {
    for (int x = 0; x < size.width; ++x) {
      image.rgb.push_back(static_cast<std::uint8_t>(255 * x / (size.width - 1)));
      image.rgb.push_back(static_cast<std::uint8_t>(255 * y / (size.height - 1)));
      image.rgb.push_back(100);
    }
  }
  return image;
}

TEST(LensTableTest, TakesEachPixelFromItsDirection) {
  const robot::CameraSpec camera = Camera();
  LensTable lens(camera);
  const PictureSize straight = lens.straight();
  const Image& bent = lens.Bend(Slopes(straight), 1);
  ASSERT_EQ(bent.width, 320);
  ASSERT_EQ(bent.height, 180);
  const double reach = robot::ReachOf(camera).y();
  for (int v = 0; v < 180; v += 7) {
    for (int u = 0; u < 320; u += 7) {
      const Eigen::Vector2d at =
          robot::DirectionOf(camera, Eigen::Vector2d(u, v)) * straight.height / (2 * reach);
      const auto i = 3 * static_cast<std::size_t>(v * 320 + u);
      EXPECT_NEAR(bent.rgb[i], 255 * (at.x() / (straight.width - 1) + 0.5), 2) << u << ", " << v;
      EXPECT_NEAR(bent.rgb[i + 1], 255 * (at.y() / (straight.height - 1) + 0.5), 2)
          << u << ", " << v;
      EXPECT_EQ(bent.rgb[i + 2], 100);
    }
  }
}

TEST(LensTableTest, IsAsWideAsTheCornersNeed) {
  LensTable lens(Camera());
  EXPECT_GT(lens.straight().width, 400);
  EXPECT_LT(lens.straight().width, 520);
  EXPECT_GT(lens.straight().height, 180);
}

TEST(LensTableTest, DimsThePicture) {
  LensTable lens(Camera());
  const Image straight = Slopes(lens.straight());
  EXPECT_EQ(lens.Bend(straight, 0.1).rgb[2], 10);
  EXPECT_EQ(lens.Bend(straight, 0).rgb[2], 0);
}

TEST(LensTableTest, TakesEachDepthFromTheNearestPixel) {
  robot::CameraSpec camera = Camera();
  camera.depth = {0.3, 10};
  LensTable lens(camera);
  const PictureSize straight = lens.straight();
  std::vector<float> slope;  // 1 m at the left and at the top, 1 cm more with each pixel
  for (int y = 0; y < straight.height; ++y) {
    for (int x = 0; x < straight.width; ++x) slope.push_back(1 + 0.01F * static_cast<float>(x + y));
  }
  const DepthImage bent = lens.BendDepths(slope);
  ASSERT_EQ(bent.mm.size(), 320U * 180U);
  ASSERT_EQ(bent.width, 320);
  const double reach = robot::ReachOf(camera).y();
  double off = 0;
  int seen = 0;
  for (int v = 0; v < 180; v += 7) {
    for (int u = 0; u < 320; u += 7, ++seen) {
      const Eigen::Vector2d at =
          robot::DirectionOf(camera, Eigen::Vector2d(u, v)) * straight.height / (2 * reach);
      const double expected =
          1000 + 10 * (at.x() + at.y() + (straight.width + straight.height - 2) / 2.0);
      const double depth = bent.mm[static_cast<std::size_t>(v * 320 + u)];
      EXPECT_NEAR(depth, expected, 15) << u << ", " << v;
      off += depth - expected;
    }
  }
  EXPECT_NEAR(off / seen, 0, 1) << "of a pixel's 10";
}

TEST(LensTableTest, KnowsNoDepthOutsideTheCamerasRange) {
  robot::CameraSpec camera = Camera();
  camera.depth = {0.3, 10};
  LensTable lens(camera);
  const PictureSize straight = lens.straight();
  const auto seen = [&](float depth) {
    const std::vector<float> even(static_cast<std::size_t>(straight.width * straight.height),
                                  depth);
    return lens.BendDepths(even).mm[1000];
  };
  EXPECT_EQ(seen(0.29F), 0);
  EXPECT_EQ(seen(0.31F), 310);
  EXPECT_EQ(seen(9.99F), 9990);
  EXPECT_EQ(seen(10.01F), 0);
}

}  // namespace
}  // namespace understudy::viewer
