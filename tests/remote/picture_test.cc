#include "remote/picture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robot/remote_keys.h"

namespace understudy::remote {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(PictureTest, ShowsEveryKeyWithTheOneThatPressesIt) {
  const std::string screen = Draw({.title = "of go2"}, 80, 24);
  EXPECT_THAT(screen, HasSubstr("of go2"));
  for (const std::string_view key : robot::kRemoteKeys)
    EXPECT_THAT(screen, HasSubstr(std::string(key)));
  EXPECT_THAT(screen, HasSubstr("L2:w"));
  EXPECT_THAT(screen, Not(HasSubstr("\033[7m")));
}

TEST(PictureTest, LightsWhatIsPressed) {
  const std::string screen = Draw({.reading = {.keys = 0x220}}, 80, 24);
  EXPECT_THAT(screen, HasSubstr("\033[7m L2:w \033[0m"));
  EXPECT_THAT(screen, HasSubstr("\033[7m B:b \033[0m"));
  EXPECT_THAT(screen, Not(HasSubstr("\033[7m A")));
}

TEST(PictureTest, ShowsWhereTheSticksAre) {
  const std::string screen = Draw({.reading = {.lx = -1, .ly = 1, .ry = -0.25}}, 80, 24);
  EXPECT_THAT(screen, HasSubstr("|\033[7mo\033[0m          |"));
  EXPECT_THAT(screen, HasSubstr("lx -1.00"));
  EXPECT_THAT(screen, HasSubstr("ry -0.25"));
}

TEST(PictureTest, FitsIntoASmallTerminal) {
  const std::string screen = Draw({.reading = {.keys = 0xFFFF}, .notes = {"a", "b"}}, 10, 3);
  EXPECT_EQ(std::count(screen.begin(), screen.end(), '\n'), 2);
  EXPECT_THAT(screen, Not(HasSubstr("R2")));
  EXPECT_FALSE(Draw({}, 0, 0).empty());
}

TEST(PictureTest, PassesOnNothingThatATerminalWouldObey) {
  const std::string screen = Draw({.title = "\033]0;x\a", .notes = {"pad \x9b\x01"}}, 80, 24);
  EXPECT_THAT(screen, HasSubstr("?]0;x?"));
  EXPECT_THAT(screen, HasSubstr("pad ??"));
}

}  // namespace
}  // namespace understudy::remote
