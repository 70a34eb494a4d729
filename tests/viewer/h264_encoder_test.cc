// Decoded by ffmpeg.
#include "viewer/h264_encoder.h"

#include <array>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "tests/support/temporary_folder.h"

namespace understudy::viewer {
namespace {

using Colour = std::array<std::uint8_t, 3>;
using testing::ElementsAre;

constexpr int kParameters = 7, kPicture = 8, kWhole = 5, kDifference = 1;  // types of NAL units
constexpr double kHz = 10;

// The left half of one colour, the right half of another.
Image Halves(const PictureSize& size, const Colour& left, const Colour& right) {
  Image image{.width = size.width, .height = size.height, .rgb = {}};
  for (int v = 0; v < size.height; ++v) {
    for (int u = 0; u < size.width; ++u) {
      const Colour& colour = u < size.width / 2 ? left : right;
      image.rgb.insert(image.rgb.end(), colour.begin(), colour.end());
    }
  }
  return image;
}

// The types of a frame's units, without libx264's remarks (6).
std::vector<int> TypesOf(const std::string& frame) {
  std::vector<int> types;
  for (std::size_t at = 0; (at = frame.find(std::string("\0\0\1", 3), at)) != std::string::npos;) {
    at += 3;
    if (const int type = frame.at(at) & 0x1F; type != 6) types.push_back(type);
  }
  return types;
}

// The last picture of a stream, of that size.
Image Decoded(const std::string& stream, const PictureSize& size) {
  const test::TemporaryFolder folder;
  const std::string in = folder.Write("a.h264", stream).string(), out = in + ".raw";
  const std::string command = "ffmpeg -loglevel error -f h264 -i '" + in +
                              "' -vf scale=in_color_matrix=auto -f rawvideo -pix_fmt rgb24 '" +
                              out + "'";
  EXPECT_EQ(std::system(command.c_str()), 0);
  std::ifstream file(out, std::ios::binary);
  const std::vector<std::uint8_t> all{std::istreambuf_iterator<char>(file), {}};
  const std::size_t bytes = 3U * static_cast<std::size_t>(size.width * size.height);
  EXPECT_EQ(all.size() % bytes, 0U);
  if (all.size() < bytes) return {};
  return {.width = size.width,
          .height = size.height,
          .rgb = {all.end() - static_cast<std::ptrdiff_t>(bytes), all.end()}};
}

Colour ColourAt(const Image& image, int u, int v) {
  const auto i = 3 * static_cast<std::size_t>(v * image.width + u);
  return {image.rgb.at(i), image.rgb.at(i + 1), image.rgb.at(i + 2)};
}

auto IsNear(const Colour& colour) {
  const auto near = [](std::uint8_t value) {
    return testing::AllOf(testing::Ge(value - 6), testing::Le(value + 6));
  };
  return ElementsAre(near(colour[0]), near(colour[1]), near(colour[2]));
}

TEST(H264EncoderTest, KeepsTheColoursOfAPicture) {
  constexpr PictureSize kSize{.width = 64, .height = 48};
  const Colour red{200, 30, 40}, blue{20, 60, 180};
  H264Encoder encoder(kSize, kHz);
  const Image seen = Decoded(encoder.Encode(Halves(kSize, red, blue), 0), kSize);
  EXPECT_THAT(ColourAt(seen, 10, 24), IsNear(red));
  EXPECT_THAT(ColourAt(seen, 54, 24), IsNear(blue));
}

TEST(H264EncoderTest, GivesAFrameForEachPictureAtOnce) {
  constexpr PictureSize kSize{.width = 64, .height = 48};
  H264Encoder encoder(kSize, kHz);
  std::string stream;
  Colour colour{0, 100, 100};
  for (int i = 0; i < 5; ++i) {
    colour[0] = static_cast<std::uint8_t>(50 * i);
    stream += encoder.Encode(Halves(kSize, colour, colour), i / kHz);
    EXPECT_THAT(ColourAt(Decoded(stream, kSize), 32, 24), IsNear(colour)) << i;
  }
}

TEST(H264EncoderTest, LetsAReaderJoinAtTheFirstFrameAndEveryTwoSeconds) {
  constexpr PictureSize kSize{.width = 64, .height = 48};
  const Image grey = Halves(kSize, {90, 90, 90}, {120, 120, 120});
  H264Encoder encoder(kSize, kHz);
  std::set<int> keys;
  std::string second;
  for (int i = 0; i < 45; ++i) {
    const std::string frame = encoder.Encode(grey, i / kHz);
    const std::vector<int> types = TypesOf(frame);
    if (types.front() == kParameters) {
      EXPECT_THAT(types, ElementsAre(kParameters, kPicture, kWhole)) << i;
      keys.insert(i);
    } else {
      EXPECT_THAT(types, ElementsAre(kDifference)) << i;
    }
    if (i >= 20 && i < 25) second += frame;
  }
  EXPECT_THAT(keys, ElementsAre(0, 20, 40));
  EXPECT_THAT(ColourAt(Decoded(second, kSize), 10, 24), IsNear({90, 90, 90}));
}

TEST(H264EncoderTest, BeginsAnewAfterAStepBackInTime) {
  constexpr PictureSize kSize{.width = 64, .height = 48};
  const Image grey = Halves(kSize, {90, 90, 90}, {120, 120, 120});
  H264Encoder encoder(kSize, kHz);
  encoder.Encode(grey, 5);
  EXPECT_THAT(TypesOf(encoder.Encode(grey, 5.1)), ElementsAre(kDifference));
  EXPECT_EQ(TypesOf(encoder.Encode(grey, 0)).front(), kParameters);
}

TEST(H264EncoderTest, HasTheHighProfile) {
  constexpr PictureSize kSize{.width = 64, .height = 48};
  H264Encoder encoder(kSize, kHz);
  const std::string frame = encoder.Encode(Halves(kSize, {1, 2, 3}, {4, 5, 6}), 0);
  const std::size_t parameters = frame.find(std::string("\0\0\1\x67", 4));
  ASSERT_NE(parameters, std::string::npos);
  EXPECT_EQ(frame.at(parameters + 4), 100);
}

TEST(H264EncoderTest, ScalesAWiderPictureToTheStreamsSize) {
  constexpr PictureSize kPictureSize{.width = 1920, .height = 1080};
  constexpr PictureSize kVideo{.width = 1280, .height = 720};
  const Colour red{200, 30, 40}, blue{20, 60, 180};
  H264Encoder encoder(kPictureSize, kHz);
  const Image seen = Decoded(encoder.Encode(Halves(kPictureSize, red, blue), 0), kVideo);
  EXPECT_THAT(ColourAt(seen, 600, 360), IsNear(red));
  EXPECT_THAT(ColourAt(seen, 680, 719), IsNear(blue));
}

TEST(H264EncoderTest, CutsAnOddRowAndColumnOff) {
  constexpr PictureSize kOdd{.width = 65, .height = 49};
  const Colour red{200, 30, 40}, blue{20, 60, 180};
  H264Encoder encoder(kOdd, kHz);
  EXPECT_THAT(
      ColourAt(Decoded(encoder.Encode(Halves(kOdd, red, blue), 0), {.width = 64, .height = 48}), 54,
               40),
      IsNear(blue));
}

}  // namespace
}  // namespace understudy::viewer
