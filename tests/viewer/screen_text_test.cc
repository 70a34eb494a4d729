#include "viewer/screen_text.h"

#include <nlohmann/json.hpp>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::viewer {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(ScreenTextTest, SaysTimeSpeedAndWhoHoldsTheMotors) {
  SceneState state;
  state.time = 12.345;
  state.speed = 0.5;
  const TextBlock text = StatusText(state, 0.499, "mcf");
  EXPECT_EQ(text.left, "time\nspeed\nmotors");
  EXPECT_EQ(text.right, "12.35 s\n0.5  (0.50 x real time)\nmcf");
}

TEST(ScreenTextTest, NamesTheStateOfTheServiceThatMovesTheMotors) {
  const auto said = [](const char* motion) {
    return MotorsText(nlohmann::json::parse(motion, nullptr, false));
  };
  EXPECT_EQ(said(R"({"motion": {"service": "mcf", "state": 1004, "name": "lying"}})"),
            "mcf, lying (1004)");
  EXPECT_EQ(said(R"({"motion": {"service": "", "state": 0, "name": ""}})"),
            "none: motors follow rt/lowcmd");
  for (const char* untold : {"", "7", "{}", R"({"motion": 7})", R"({"motion": {"service": "mcf"}})",
                             R"({"motion": {"service": 7, "state": 1004, "name": "lying"}})"}) {
    EXPECT_EQ(said(untold), "") << untold;
  }
}

TEST(ScreenTextTest, SaysThatItIsPaused) {
  SceneState state;
  EXPECT_THAT(StatusText(state, 1, "").right, Not(HasSubstr("PAUSED")));
  state.paused = true;
  EXPECT_THAT(StatusText(state, 0, "").right, HasSubstr("PAUSED"));
}

TEST(ScreenTextTest, ShowsTheKeysThatAreDown) {
  SceneState state;
  state.keys = "L2+B";
  EXPECT_THAT(StatusText(state, 1, "").right, HasSubstr("L2+B"));
}

TEST(ScreenTextTest, MeasuresTheRealTimeFactorOverTheLastSecond) {
  RealTimeFactor factor;
  EXPECT_EQ(factor.value(), 0);
  for (int i = 0; i <= 40; ++i) factor.Add(0.01 * i, 0.1 * i);
  EXPECT_NEAR(factor.value(), 0.1, 1e-9);
  for (int i = 1; i <= 20; ++i) factor.Add(0.4 + 0.1 * i, 4 + 0.1 * i);
  EXPECT_NEAR(factor.value(), 1, 1e-9);
}

TEST(ScreenTextTest, BeginsAnewWhenTimeGoesBack) {
  RealTimeFactor factor;
  factor.Add(10, 1);
  factor.Add(0, 1.1);
  EXPECT_EQ(factor.value(), 0);
}

TEST(ScreenTextTest, ShowsTheLastEventsOfATime) {
  const std::vector<FilmEvent> events = {{0, "a"},    {1, "b"},     {2, "c"},  {2.5, "d"},
                                         {2.75, "e"}, {2.875, "f"}, {3.5, "g"}};
  const Caption caption = CaptionAt(3, 2.5, events);
  EXPECT_EQ(caption.clock, "3.00 s");
  EXPECT_THAT(caption.events,
              testing::ElementsAre("2.00 s  c", "2.50 s  d", "2.75 s  e", "2.88 s  f"));
  EXPECT_THAT(CaptionAt(3, 1, events).events, testing::SizeIs(3)) << "2 s is not within 1 s of 3";
  EXPECT_THAT(CaptionAt(10, 1, events).events, testing::IsEmpty());
}

TEST(ScreenTextTest, IsInLettersThatTheFontHas) {
  EXPECT_EQ(InFontsLetters("5 N·m at 30 °C, é\n…"), "5 N*m at 30  degC, ? ...");
  EXPECT_EQ(InFontsLetters("cut \xE2\x80"), "cut ?");
}

}  // namespace
}  // namespace understudy::viewer
