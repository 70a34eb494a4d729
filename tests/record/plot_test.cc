#include "record/plot.h"

#include <numbers>

#include <gmock/gmock.h>

#include "record/truth.h"
#include "tests/record/mcap_files.h"

namespace understudy {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

class PlotTest : public McapFilesTest {
 protected:
  // A base that rises from 0.1 to 0.3 m in 10 s and turns by 90 degrees; 10,000 moments.
  std::filesystem::path Rising(const std::vector<Event>& events = {}) {
    McapWriter writer(OutputFile(File(), true), "ros2", "a test");
    writer.AddMetadata("understudy", {{"robot", "go2"}, {"start_time_ns", "1000"}});
    const auto truth = writer.AddChannel(
        kTruthTopic, writer.AddSchema(kTruthType, "ros2msg", kTruthText), "cdr", {});
    const auto event = writer.AddChannel(
        kEventTopic, writer.AddSchema(kEventType, "ros2msg", kEventText), "cdr", {});
    BytesOut message;
    for (int i = 0; i <= 10'000; ++i) {
      const double share = i / 10'000.0;
      const double half = share * std::numbers::pi / 4;
      EncodeTruth({.step = i,
                   .qpos = {0, 0, 0.1 + 0.2 * share, std::cos(half), 0, 0, std::sin(half)},
                   .qvel = std::vector<double>(6)},
                  &message);
      const std::uint64_t time = 1000 + static_cast<std::uint64_t>(i) * 1'000'000;
      writer.Write(truth, time, time, message.span());
    }
    for (const Event& one : events) {
      EncodeEvent(one, &message);
      const auto time = 1000 + static_cast<std::uint64_t>(one.time * 1e9);
      writer.Write(event, time, time, message.span());
    }
    writer.Finish();
    return File();
  }
};

TEST_F(PlotTest, DrawsHeightAndAttitudeOfTheBase) {
  const PlotPage page = MakePage(McapReader(Rising()), {});
  ASSERT_THAT(page.panels, SizeIs(2));
  EXPECT_EQ(page.panels[0].label, "height [m]");
  EXPECT_NEAR(page.panels[0].lines[0].points.front().second, 0.1, 1e-9);
  EXPECT_NEAR(page.panels[0].lines[0].points.back().second, 0.3, 1e-9);
  EXPECT_EQ(page.panels[1].lines[2].name, "yaw");
  EXPECT_NEAR(page.panels[1].lines[2].points.back().second, 90, 1e-6);
  EXPECT_THAT(page.title, HasSubstr("go2"));
}

TEST_F(PlotTest, DrawsNoMorePointsThanAPictureShows) {
  const PlotPage page = MakePage(McapReader(Rising()), {});
  EXPECT_LE(page.panels[0].lines[0].points.size(), 2402U);
  EXPECT_GT(page.panels[0].lines[0].points.size(), 1000U);
}

TEST_F(PlotTest, DrawsAPart) {
  const PlotPage page = MakePage(McapReader(Rising()), {.from = 2, .to = 4});
  EXPECT_NEAR(page.panels[0].lines[0].points.front().first, 2, 1e-6);
  EXPECT_NEAR(page.panels[0].lines[0].points.back().first, 4, 1e-6);
  EXPECT_THAT([&] { MakePage(McapReader(File()), {.from = 50}); },
              ThrowsMessage<RecordError>(HasSubstr("there is nothing from")));
}

TEST_F(PlotTest, MakesOneMarkOfACrowd) {
  std::vector<Event> events;
  for (int i = 0; i < 5; ++i) {
    events.push_back({.time = 1 + 0.1 * i, .kind = "refused", .text = "refused 1 LowCmd (crc)"});
  }
  events.push_back({.time = 8, .kind = "refused", .text = "refused 1 LowCmd (gain)"});
  const PlotPage page = MakePage(McapReader(Rising(events)), {});
  ASSERT_THAT(page.marks, SizeIs(2));
  EXPECT_EQ(page.marks[0].times, 5);
  EXPECT_EQ(page.marks[1].text, "refused 1 LowCmd (gain)");
}

// What a file says is drawn, not done.
TEST_F(PlotTest, QuotesWhatTheFileSays) {
  const std::vector<Event> events{
      {.time = 1, .kind = "order", .text = "'; system('rm -rf x') #\n`reboot`"}};
  const std::string script =
      GnuplotScript(MakePage(McapReader(Rising(events)), {}), false, "a'b.png");
  EXPECT_THAT(script, HasSubstr("'''; system(''rm -rf x'') # `reboot`'"));
  EXPECT_THAT(script, HasSubstr("set output 'a''b.png'"));
  EXPECT_THAT(script, Not(HasSubstr("\n`reboot`")));
}

TEST_F(PlotTest, NamesTheNearestWord) {
  const McapReader reader(Rising());
  EXPECT_THAT([&] { MakePage(reader, {.motors = {"FR_clf"}}); },
              ThrowsMessage<RecordError>(HasSubstr("--motors: no motor 'FR_clf'")));
  EXPECT_THAT([&] { MakePage(reader, {.fields = {"ta"}}); },
              ThrowsMessage<RecordError>(HasSubstr("did you mean 'tau'?")));
  EXPECT_THAT([&] { MakePage(reader, {.signals = {"understudy/trut:time"}}); },
              ThrowsMessage<RecordError>(HasSubstr("did you mean 'understudy/truth'?")));
  EXPECT_THAT([&] { MakePage(reader, {.signals = {"tick"}}); },
              ThrowsMessage<RecordError>(HasSubstr("expected TOPIC:FIELD")));
}

TEST_F(PlotTest, WantsAPictureThatItCanDraw) {
  EXPECT_THAT([&] { DrawPage(MakePage(McapReader(Rising()), {}), File("a.gif")); },
              ThrowsMessage<RecordError>(HasSubstr("expected a name that ends in .png or .svg")));
}

}  // namespace
}  // namespace understudy
