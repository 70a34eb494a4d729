#include <filesystem>
#include <fstream>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"
#include "tests/support/temporary_folder.h"
#include "viewer/canvas.h"

namespace understudy::viewer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(ImageTest, HalvesByTheMeanOfFourPixels) {
  const Image big{.width = 4, .height = 2, .rgb = {0, 0, 0, 4, 8, 0, 10, 10, 10, 10, 10, 10,
                                                   4, 0, 0, 8, 8, 0, 10, 10, 10, 10, 10, 10}};
  const Image half = Halve(big);
  EXPECT_EQ(half.width, 2);
  EXPECT_EQ(half.height, 1);
  EXPECT_THAT(half.rgb, ElementsAre(4, 4, 0, 10, 10, 10));
}

TEST(ImageTest, WritesAPng) {
  const test::TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "a.png";
  WritePng({.width = 2, .height = 1, .rgb = {1, 2, 3, 4, 5, 6}}, file);
  std::string head(8, '\0');
  std::ifstream(file, std::ios::binary).read(head.data(), 8);
  EXPECT_EQ(head, "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

TEST(ImageTest, SaysWhyAPngCannotBeWritten) {
  EXPECT_THAT(
      [] {
        WritePng({.width = 1, .height = 1, .rgb = {1, 2, 3}}, "/proc/nowhere/a.png");
      },
      ThrowsMessage<SetupError>(HasSubstr("cannot write /proc/nowhere/a.png")));
}

TEST(ImageTest, LeavesNothingWhereItsNameIsAFolders) {
  const test::TemporaryFolder folder;
  std::filesystem::create_directory(folder.path() / "a.png");
  EXPECT_THAT(
      [&] {
        WritePng({.width = 1, .height = 1, .rgb = {1, 2, 3}}, folder.path() / "a.png");
      },
      ThrowsMessage<SetupError>(HasSubstr("a.png")));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder.path()), {}), 1);
}

}  // namespace
}  // namespace understudy::viewer
