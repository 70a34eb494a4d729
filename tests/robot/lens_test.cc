#include "robot/lens.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

using Eigen::Vector2d;

// A Go2's.
CameraSpec Camera() {
  CameraSpec camera;
  camera.focal = {864.4, 863.7};
  camera.centre = {639.2, 373.3};
  camera.distortion = {-0.3546, 0.1021, -0.0016, -0.0012};
  return camera;
}

TEST(LensTest, SeesItsAxisAtItsCentre) {
  EXPECT_LT((PixelOf(Camera(), {0, 0}) - Vector2d(639.2, 373.3)).norm(), 1e-12);
  EXPECT_LT(DirectionOf(Camera(), {639.2, 373.3}).norm(), 1e-12);
}

TEST(LensTest, WithoutDistortionIsAPinhole) {
  CameraSpec camera = Camera();
  camera.distortion = {};
  EXPECT_NEAR(PixelOf(camera, {0.5, 0}).x(), 639.2 + 432.2, 1e-9);
  EXPECT_NEAR(PixelOf(camera, {0, 0.5}).y(), 373.3 + 431.85, 1e-9);
}

// By hand, by the formulas of OpenCV's page on calibration.
TEST(LensTest, BendsAsOpenCvDoes) {
  // r2 = 0.3125, radial 0.899158; xy = -0.125.
  const Vector2d pixel = PixelOf(Camera(), {0.5, -0.25});
  EXPECT_NEAR(pixel.x(), 639.2 + 864.4 * (0.449579 + 0.000400 - 0.000975), 1e-3);
  EXPECT_NEAR(pixel.y(), 373.3 + 863.7 * (-0.2247895 - 0.000700 + 0.000300), 1e-3);
}

TEST(LensTest, FindsTheDirectionOfEachPixel) {
  for (double u = 0; u < 1280; u += 53) {
    for (double v = 0; v < 720; v += 37) {
      const Vector2d pixel(u, v);
      EXPECT_LT((PixelOf(Camera(), DirectionOf(Camera(), pixel)) - pixel).norm(), 1e-4)
          << u << ", " << v;
    }
  }
}

TEST(LensTest, ReachesAsFarAsItsCorners) {
  const Vector2d reach = ReachOf(Camera());
  const Vector2d corner = DirectionOf(Camera(), {-0.5, -0.5}).cwiseAbs();
  EXPECT_GE(reach.x(), corner.x());
  EXPECT_GE(reach.y(), corner.y());
  const double across = std::atan(DirectionOf(Camera(), {1279.5, 373.3}).x()) -
                        std::atan(DirectionOf(Camera(), {-0.5, 373.3}).x());
  EXPECT_NEAR(across * 180 / std::numbers::pi, 89, 1);
}

}  // namespace
}  // namespace understudy::robot
