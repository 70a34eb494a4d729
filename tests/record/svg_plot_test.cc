#include "record/svg_plot.h"

#include <gmock/gmock.h>

namespace understudy::record {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

TEST(SvgPlotTest, DrawsTheLimitTheWindowAndTheInstant) {
  const std::string svg = DrawSvg({.label = "a < b",
                                   .to = 2,
                                   .lines = {{.kind = "signal", .points = {{0, 1}, {1, 3}}}},
                                   .limits = {2},
                                   .window = std::pair(0.5, 1.5),
                                   .at = 1,
                                   .events = {{1, "x & y"}}});
  for (const char* part : {"class=\"limit\"", "class=\"window\"", "class=\"instant\"",
                           "class=\"signal\"", "a &lt; b", "x &amp; y"}) {
    EXPECT_THAT(svg, HasSubstr(part));
  }
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

TEST(SvgPlotTest, DrawsASignalThatNeverChanges) {
  EXPECT_THAT(DrawSvg({.lines = {{.points = {{0, 0}, {1, 0}}}}}), Not(HasSubstr("nan")));
}

TEST(SvgPlotTest, DrawsAllLinesOnTheSameAxesAndNamesThem) {
  const std::string svg =
      DrawSvg({.lines = {{.kind = "a", .points = {{0, 0}, {1, 1}}},
                         {.kind = "b", .points = {{0, 3}, {1, 3}}, .name = "the <other>"}}});
  EXPECT_THAT(svg, HasSubstr("class=\"a\""));
  EXPECT_THAT(svg, HasSubstr(">3</text>"));  // within the range
  EXPECT_THAT(svg, HasSubstr("the &lt;other&gt;</text>"));
}

TEST(SvgPlotTest, HoldsAValueToTheEndUnlessAPauseInterruptsTheLine) {
  const auto moves = [](double gap) {
    const std::string svg =
        DrawSvg({.to = 10, .lines = {{.points = {{0, 0}, {1, 1}, {5, 1}}, .gap = gap}}});
    const std::size_t path = svg.find("<path");
    std::size_t count = 0;
    for (std::size_t at = path; svg[at] != '/'; ++at) count += svg[at] == 'M' ? 1U : 0U;
    return count;
  };
  EXPECT_EQ(moves(0), 1U);
  EXPECT_EQ(moves(2), 2U);
  EXPECT_THAT(DrawSvg({.to = 10, .lines = {{.points = {{0, 0}, {5, 1}}}}}), HasSubstr("L630.0,"));
}

TEST(TicksTest, AreRoundAndInside) {
  EXPECT_EQ(Ticks(-0.1, 1.1, 4), (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(Ticks(0, 40, 4), (std::vector<double>{0, 10, 20, 30, 40}));
}

}  // namespace
}  // namespace understudy::record
