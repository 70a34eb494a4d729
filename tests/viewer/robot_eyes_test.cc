// Draws with the OpenGL of this machine, usually Mesa's software renderer.
#include "viewer/robot_eyes.h"

#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <png.h>

#include "base/errors.h"
#include "robot/lens.h"
#include "viewer/jpeg.h"
#include "viewer_test.h"

namespace understudy::viewer {
namespace {

// The camera of the test's world looks down from 20 m; the ball floats at 5 m.
robot::CameraSpec Above() {
  robot::CameraSpec camera;
  camera.name = "above";
  camera.width = 160;
  camera.height = 120;
  camera.focal = {145, 145};  // 45 degrees, as MuJoCo's cameras
  camera.centre = {79.5, 59.5};
  return camera;
}

TEST(RobotEyesTest, SeesWhatIsThereAgainAndAgain) {
  RobotEyes eyes(BallModel(), "");
  const auto red = [&](double x, int column) {
    const Image& image = eyes.See(Above(), 1, BallAt(x));
    const auto i = 3 * static_cast<std::size_t>(60 * image.width + column);
    return image.rgb[i] > 2 * image.rgb[i + 2];
  };
  EXPECT_TRUE(red(0, 86));
  EXPECT_FALSE(red(0, 118));
  EXPECT_TRUE(red(4, 118));
  EXPECT_FALSE(red(4, 86));
  EXPECT_TRUE(red(0, 86));
}

TEST(RobotEyesTest, DrawsTheSameStateBitForBit) {
  RobotEyes eyes(BallModel(), "");
  const std::string first = EncodeJpeg(eyes.See(Above(), 1, BallAt(1)), 90);
  eyes.See(Above(), 1, BallAt(2));
  EXPECT_EQ(EncodeJpeg(eyes.See(Above(), 1, BallAt(1)), 90), first);
}

TEST(RobotEyesTest, RefusesACameraThatTheModelLacks) {
  RobotEyes eyes(BallModel(), "");
  robot::CameraSpec camera = Above();
  camera.name = "below";
  EXPECT_THROW(eyes.See(camera, 1, BallAt(0)), ModelError);
}

TEST(RobotEyesTest, KeepsTheLastPictureOfEachCamera) {
  RobotEyes eyes(BallModel(), "");
  EXPECT_EQ(eyes.Last(Above()), nullptr);
  const Image first = eyes.See(Above(), 1, BallAt(0));
  ASSERT_NE(eyes.Last(Above()), nullptr);
  EXPECT_EQ(eyes.Last(Above())->rgb, first.rgb);
  eyes.See(Above(), 0.5, BallAt(4));
  EXPECT_NE(eyes.Last(Above())->rgb, first.rgb);
}

TEST(RobotEyesTest, SeesWithTwoEyesSideBySideAtOneInstant) {
  std::string world = kBallWorld;
  world.insert(world.find("<camera"), R"(<camera name="above_right" pos="2 0 20"/>)");
  RobotEyes eyes(mjcf::ReadBinaryModel(BinaryModel(world), "the test's"), "");
  robot::CameraSpec camera = Above();
  camera.baseline = 2;
  const auto red = [&](int column) {
    const Image& image = *eyes.Last(camera);
    const auto i = 3 * static_cast<std::size_t>(60 * image.width + column);
    return image.rgb[i] > 2 * image.rgb[i + 2];
  };
  eyes.See(camera, 1, BallAt(0));
  const Image& both = eyes.See(camera, 1, BallAt(0));
  ASSERT_EQ(both.width, 2 * camera.width);
  ASSERT_EQ(both.height, camera.height);
  ASSERT_EQ(both.rgb.size(), std::size_t{3 * 320 * 120});
  // 2 m to the right of the left eye, the right one sees what is 15 m away 19 pixels further left.
  EXPECT_TRUE(red(86));
  EXPECT_FALSE(red(67 - 9));
  EXPECT_TRUE(red(160 + 67));
  EXPECT_FALSE(red(160 + 86));
}

TEST(RobotEyesTest, SpreadsColoursByTheNoiseOfTheInstant) {
  RobotEyes eyes(BallModel(), "");
  const Image clear = eyes.See(Above(), 1, BallAt(0, 2));
  const Image noisy = eyes.See(Above(), 1, BallAt(0, 2), 10);
  double sum = 0, squares = 0, count = 0;
  for (std::size_t i = 0; i < clear.rgb.size(); ++i) {
    if (clear.rgb[i] < 40 || clear.rgb[i] > 215) continue;  // would be cut
    const double off = noisy.rgb[i] - clear.rgb[i];
    sum += off;
    squares += off * off;
    ++count;
  }
  ASSERT_GT(count, 500);
  EXPECT_NEAR(sum / count, 0, 1);
  EXPECT_NEAR(std::sqrt(squares / count), 10, 1);
  EXPECT_EQ(eyes.Last(Above())->rgb, noisy.rgb) << "what is stuck keeps its noise";
  EXPECT_EQ(eyes.See(Above(), 1, BallAt(0, 2), 10).rgb, noisy.rgb);
  EXPECT_NE(eyes.See(Above(), 1, BallAt(0, 2.5), 10).rgb, noisy.rgb);
  EXPECT_EQ(eyes.See(Above(), 1, BallAt(0, 2)).rgb, clear.rgb);
}

TEST(RobotEyesTest, LeavesTheSunsShadowsOutWhereNoCardDraws) {
  std::string world = kBallWorld;
  const std::string down = "dir=\"0 0 -1\"";
  world.replace(world.find(down), down.size(), "dir=\"0.8 0 -1\"");  // its shadow: 4 m aside
  RobotEyes eyes(mjcf::ReadBinaryModel(BinaryModel(world), "the test's"), "");
  const Image& image = eyes.See(Above(), 1, BallAt(0));
  const auto floor = [&](int column) {
    return image.rgb[3 * static_cast<std::size_t>(60 * image.width + column)];
  };
  const bool dark = floor(108) < floor(50) - 5;
  EXPECT_EQ(dark, eyes.has_shadows());
}

TEST(HeadlessGlTest, KnowsMesasRenderersThatNeedNoCard) {
  EXPECT_TRUE(IsSoftwareRenderer("llvmpipe (LLVM 15.0.6, 256 bits)"));
  EXPECT_TRUE(IsSoftwareRenderer("softpipe"));
  EXPECT_FALSE(IsSoftwareRenderer("NVIDIA GeForce RTX 3060/PCIe/SSE2"));
  EXPECT_FALSE(IsSoftwareRenderer("Mesa Intel(R) UHD Graphics 620 (KBL GT2)"));
}

// Of a PNG of 16 bits: the value of that pixel.
int DepthAt(const std::string& png, png_uint_32 column, png_uint_32 row) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_memory(&image, png.data(), png.size()), 0) << image.message;
  EXPECT_EQ(image.format, PNG_FORMAT_LINEAR_Y);
  std::vector<std::uint16_t> grey(std::size_t{image.width} * image.height);
  EXPECT_NE(png_image_finish_read(&image, nullptr, grey.data(), 0, nullptr), 0) << image.message;
  return grey[row * image.width + column];
}

TEST(RobotEyesTest, MeasuresAlongItsAxisWithinItsRange) {
  RobotEyes eyes(BallModel(), "");
  robot::CameraSpec camera = Above();
  camera.depth = {1, 30};
  eyes.See(camera, 1, BallAt(0));
  const std::string all = eyes.Depth(camera);
  EXPECT_NEAR(DepthAt(all, 10, 60), 20000, 5) << "the floor";
  EXPECT_NEAR(DepthAt(all, 10, 10), 20000, 5) << "as far along the axis, where it is farther away";
  // 6.5 pixels off its middle, 0.64 m of the ball's 1 m.
  EXPECT_NEAR(DepthAt(all, 86, 60), 14230, 30) << "the ball, whose middle is 15 m away";
  EXPECT_NEAR(DepthAt(all, 86, 67), DepthAt(all, 86, 52), 30);
}

TEST(RobotEyesTest, MeasuresTheLastPictureAsItsRowsLie) {
  RobotEyes eyes(BallModel(), "");
  robot::CameraSpec camera = Above();
  camera.depth = {1, 19};
  SceneState low = BallAt(0);
  low.qpos[1] = -4;  // towards the lower edge of the picture
  eyes.See(camera, 1, low);
  const std::string depth = eyes.Depth(camera);
  EXPECT_NEAR(DepthAt(depth, 73, 98), 14250, 80) << "the ball";
  EXPECT_EQ(DepthAt(depth, 73, 21), 0) << "the floor, beyond its range";
  EXPECT_EQ(eyes.Depth(camera), depth);
}

TEST(RobotEyesTest, FilmsAsFramesOfWhichTheFirstStandsForItself) {
  RobotEyes eyes(BallModel(), "");
  const Image& picture = eyes.See(Above(), 1, BallAt(0));
  const std::string whole = eyes.Film(Above(), picture, 0);
  const std::string difference = eyes.Film(Above(), picture, 0.1);
  const std::string parameters("\0\0\0\1\x67", 5);
  EXPECT_TRUE(whole.starts_with(parameters));
  EXPECT_FALSE(difference.starts_with(parameters));
  EXPECT_LT(difference.size(), whole.size() / 2);
}

TEST(JpegTest, HasTheMarksOfAFile) {
  const Image grey{.width = 16, .height = 8, .rgb = std::vector<std::uint8_t>(384, 128)};
  const std::string jpeg = EncodeJpeg(grey, 90);
  EXPECT_TRUE(jpeg.starts_with("\xFF\xD8\xFF"));
  EXPECT_TRUE(jpeg.ends_with("\xFF\xD9"));
}

TEST(JpegTest, IsSmallerForALowerQuality) {
  Image image{.width = 64, .height = 64, .rgb = {}};
  for (int i = 0; i < 3 * 64 * 64; ++i) {
    image.rgb.push_back(static_cast<std::uint8_t>(i * i % 251));
  }
  EXPECT_LT(EncodeJpeg(image, 40).size(), EncodeJpeg(image, 90).size() / 2);
}

}  // namespace
}  // namespace understudy::viewer
