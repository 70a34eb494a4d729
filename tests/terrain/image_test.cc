#include "terrain/image.h"

#include <fstream>
#include <sstream>
#include <string>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/support/temporary_folder.h"

namespace understudy::terrain {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

class TerrainImageTest : public testing::Test {
 protected:
  GreyImage Read(const std::string& bytes) { return ReadGreyImage(folder_.Write("image", bytes)); }
  // What the refusal says, without the folder; "" when the image is read.
  std::string Refusal(const std::string& bytes) {
    try {
      Read(bytes);
    } catch (const ModelError& error) {
      const std::string text = error.what();
      EXPECT_THAT(text, testing::StartsWith((folder_.path() / "image: ").string()));
      return text.substr(text.find("image: ") + 7);
    }
    return "";
  }
  std::string Png(int width, int height) {
    WriteGreyPng(folder_.path() / "made.png", width, height,
                 std::vector<std::uint16_t>(static_cast<std::size_t>(width * height), 4369));
    std::ifstream stream(folder_.path() / "made.png", std::ios::binary);
    std::ostringstream bytes;
    bytes << stream.rdbuf();
    return bytes.str();
  }

  test::TemporaryFolder folder_;
};

TEST_F(TerrainImageTest, ReadsBackTheSixteenBitsItWrites) {
  WriteGreyPng(folder_.path() / "made.png", 2, 3, {0, 1, 2, 32768, 65534, 65535});
  const GreyImage image = ReadGreyImage(folder_.path() / "made.png");
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.height, 3);
  EXPECT_THAT(image.grey,
              ElementsAre(0, 1 / 65535.0, 2 / 65535.0, 32768 / 65535.0, 65534 / 65535.0, 1));
}

TEST_F(TerrainImageTest, ReadsAPlainPgmWithComments) {
  const GreyImage image = Read("P2 # by hand\n3 # wide\n2\n4\n0 1 2\n3 4 # end\n0\n");
  EXPECT_EQ(image.width, 3);
  EXPECT_EQ(image.height, 2);
  EXPECT_THAT(image.grey, ElementsAre(0, 0.25, 0.5, 0.75, 1, 0));
}

TEST_F(TerrainImageTest, ReadsARawPgmOfOneAndOfTwoBytes) {
  EXPECT_THAT(Read(std::string("P5 2 2 4\n\0\1\2\4", 13)).grey, ElementsAre(0, 0.25, 0.5, 1));
  EXPECT_THAT(Read(std::string("P5 2 2 1024\n\0\0\1\0\2\0\4\0", 20)).grey,
              ElementsAre(0, 0.25, 0.5, 1));
}

TEST_F(TerrainImageTest, RefusesAFileThatIsNotThere) {
  EXPECT_THROW(ReadGreyImage(folder_.path() / "none.png"), ModelError);
}

TEST_F(TerrainImageTest, RefusesWhatIsNoImage) {
  EXPECT_EQ(Refusal("<mujoco/>"), "expected a PNG or a PGM (P2 or P5)");
  EXPECT_EQ(Refusal(""), "expected a PNG or a PGM (P2 or P5)");
}

TEST_F(TerrainImageTest, RefusesAPngThatIsCutShort) {
  const std::string png = Png(4, 4);
  for (std::size_t size = 4; size < png.size() - 12; ++size) {  // the end mark is not needed
    EXPECT_THAT(Refusal(png.substr(0, size)), HasSubstr("not a sound PNG")) << size;
  }
}

TEST_F(TerrainImageTest, RefusesAPngWithAWrongByte) {
  std::string png = Png(4, 4);
  png[png.size() - 20] = static_cast<char>(png[png.size() - 20] ^ 1);
  EXPECT_THAT(Refusal(png), HasSubstr("not a sound PNG"));
}

TEST_F(TerrainImageTest, RefusesAPngWithTooFewPixels) {
  EXPECT_EQ(Refusal(Png(1, 8)), "expected 2 to 2000 pixels on each side, got 1 x 8");
}

TEST_F(TerrainImageTest, RefusesAnImageWithTooManyPixels) {
  EXPECT_EQ(Refusal("P2 2001 2 9 "), "expected 2 to 2000 pixels on each side, got 2001 x 2");
  EXPECT_EQ(Refusal("P5 4294967295 4294967295 9 "),
            "expected 2 to 2000 pixels on each side, got 4294967295 x 4294967295");
}

TEST_F(TerrainImageTest, RefusesAPgmWithoutAHead) {
  EXPECT_THAT(Refusal("P5"), HasSubstr("expected width, height and a white"));
  EXPECT_THAT(Refusal("P2 2 2 0 1 1 1 1"), HasSubstr("expected width, height and a white"));
  EXPECT_THAT(Refusal("P2 2 x 9 1 1 1 1"), HasSubstr("expected width, height and a white"));
  EXPECT_THAT(Refusal("P5 2 2 65536 "), HasSubstr("expected width, height and a white"));
}

TEST_F(TerrainImageTest, RefusesAPgmThatIsCutShort) {
  EXPECT_EQ(Refusal("P2 2 2 9 1 1 1"), "invalid PGM: cut short");
  EXPECT_EQ(Refusal("P5 2 2 9 111"), "invalid PGM: cut short");
}

TEST_F(TerrainImageTest, RefusesAPgmPixelWhiterThanWhite) {
  EXPECT_EQ(Refusal("P2 2 2 9 1 1 1 10"), "invalid PGM: a pixel exceeds the value of white");
}

}  // namespace
}  // namespace understudy::terrain
