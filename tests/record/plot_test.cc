#include "record/plot.h"

#include <cstring>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>

#include "record/cdr_field.h"
#include "record/truth.h"
#include "robot/robot_values.h"
#include "tests/record/runs.h"

namespace understudy::record {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::SizeIs;
using ::testing::ThrowsMessage;

class PlotTest : public RunsTest {
 protected:
  // A base that rises from 0.1 to 0.3 m in 10 s and turns by 90 degrees; 10,000 moments.
  std::filesystem::path Rising(const std::vector<RecordedEvent>& events = {}) {
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
    for (const RecordedEvent& one : events) {
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

// What is large is large; what is none is left out.
TEST_F(PlotTest, LeavesOutNoValueButWhatIsNone) {
  McapWriter writer(OutputFile(File(), true), "ros2", "a test");
  const auto state = writer.AddChannel(
      "/lowstate", writer.AddSchema("unitree_go/msg/LowState", "ros2msg", ""), "cdr", {});
  const auto command = writer.AddChannel(
      "/lowcmd", writer.AddSchema("unitree_go/msg/LowCmd", "ros2msg", ""), "cdr", {});
  const auto put = [&](std::uint16_t channel, const CdrField& field, auto number, int i) {
    std::string message(2000, '\0');
    message[1] = 1;
    std::memcpy(message.data() + 4 + field.offset, &number, sizeof number);
    const std::uint64_t time = 1000 + static_cast<std::uint64_t>(i) * 100'000'000;
    writer.Write(channel, time, time, AsBytes(message));
  };
  const CdrField tick = FindField("unitree_go/msg/LowState", "tick");
  const CdrField q = FindField("unitree_go/msg/LowCmd", "motor_cmd[0].q");
  for (int i = 0; i < 10; ++i) {
    put(state, tick, static_cast<std::uint32_t>(10'000 * i), i);
    put(command, q, i < 5 ? 1.0F : static_cast<float>(robot::kNoPosition), i);
  }
  put(command, q, std::numeric_limits<float>::quiet_NaN(), 9);
  writer.Finish();
  const PlotPage page = MakePage(
      McapReader(File()),
      {.what = {
           .motors = {"0"}, .fields = {"q"}, .signals = {"rt/lowstate:tick", "/lowstate:tick"}}});
  ASSERT_THAT(page.panels, SizeIs(3));
  EXPECT_TRUE(page.panels[0].lines[0].dashed);
  EXPECT_THAT(page.panels[0].lines[0].points, SizeIs(5));
  for (const std::size_t panel : {1U, 2U}) {
    ASSERT_THAT(page.panels[panel].lines[0].points, SizeIs(10));
    EXPECT_EQ(page.panels[panel].lines[0].points.back().second, 90'000);
  }
}

TEST_F(PlotTest, SaysThatASignalIsSilent) {
  McapWriter writer(OutputFile(File(), true), "ros2", "a test");
  const auto schema = writer.AddSchema("unitree_go/msg/LowState", "ros2msg", "");
  const auto state = writer.AddChannel("/lowstate", schema, "cdr", {});
  writer.Write(state, 1000, 1000, AsBytes("short"));
  writer.Write(state, 2000, 2000, AsBytes("short"));
  writer.Finish();
  EXPECT_THAT([&] { MakePage(McapReader(File()), {.what = {.signals = {"rt/lowstate:tick"}}}); },
              ThrowsMessage<RecordError>(HasSubstr("nothing says rt/lowstate:tick from")));
}

TEST_F(PlotTest, IsNoWiderThanTheRecording) {
  EXPECT_NEAR(MakePage(McapReader(Rising()), {.what = {.to = 1e300}}).to, 10, 1e-9);
  const double none = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT([&] { MakePage(McapReader(File()), {.what = {.from = none}}); },
              ThrowsMessage<RecordError>(HasSubstr("there is nothing from")));
}

TEST_F(PlotTest, HasRoomForPanelsHoweverMuchHappened) {
  const PlotLine line{.name = "b", .points = {{0, 1}, {0.4, 2}}};
  PlotPage page{.title = "a run", .to = 10, .width = 400, .height = 600, .panels = {{"a", {line}}}};
  for (int i = 0; i < 200; ++i) {
    page.marks.push_back({.at = 0.05 * i, .kind = "push", .text = "a long story of an order"});
  }
  const std::string svg = DrawPage(page);
  std::size_t texts = 0;
  for (std::size_t at = 0; (at = svg.find("<text class=\"mark", at)) != std::string::npos; ++at) {
    ++texts;
  }
  EXPECT_EQ(texts, 8U);
  EXPECT_NO_THROW(WritePicture(page, File("a.svg")));
}

TEST_F(PlotTest, DrawsAPart) {
  const PlotPage page = MakePage(McapReader(Rising()), {.what = {.from = 2, .to = 4}});
  EXPECT_NEAR(page.panels[0].lines[0].points.front().first, 2, 1e-6);
  EXPECT_NEAR(page.panels[0].lines[0].points.back().first, 4, 1e-6);
  EXPECT_THAT([&] { MakePage(McapReader(File()), {.what = {.from = 50}}); },
              ThrowsMessage<RecordError>(HasSubstr("there is nothing from")));
}

TEST_F(PlotTest, DrawsAnotherRecordingDashedOverTheFirst) {
  const McapReader first(
      Make("first.mcap", {.events = {{.step = 1000, .time = 1, .kind = "push", .text = "push"}}}));
  const McapReader second(
      Make("second.mcap", {.height = [](double) { return 0.2; },
                           .q = [](double t) { return t; },
                           .events = {{.step = 1000, .time = 1, .kind = "reset", .text = "reset"}},
                           .named = false}));
  const PlotPage page = MakePage(first, second, 2, {.what = {.fields = {"q"}}});
  ASSERT_THAT(page.panels, SizeIs(3));
  ASSERT_THAT(page.panels[0].lines, SizeIs(2));
  EXPECT_FALSE(page.panels[0].lines[0].dashed);
  EXPECT_EQ(page.panels[0].lines[0].points.back().second, 0.3);
  EXPECT_TRUE(page.panels[0].lines[1].dashed);
  EXPECT_EQ(page.panels[0].lines[1].points.front(), std::pair(2.0, 0.2));
  ASSERT_THAT(page.panels[2].lines, SizeIs(2));
  EXPECT_EQ(page.panels[2].lines[0].name, "FR_hip");
  EXPECT_EQ(page.panels[2].lines[1].color, page.panels[2].lines[0].color);
  EXPECT_NEAR(page.panels[2].lines[1].points.back().first, 10, 0.011);
  EXPECT_NEAR(page.panels[2].lines[1].points.back().second, 8, 0.011);
  ASSERT_THAT(page.marks, SizeIs(2));
  EXPECT_EQ(page.marks[0].text, "push");
  EXPECT_EQ(page.marks[1].text, "second.mcap: reset");
  EXPECT_EQ(page.marks[1].at, 3);
  EXPECT_THAT(page.title, HasSubstr("first.mcap; dashed: go2, second.mcap"));
  EXPECT_THAT(DrawPage(page), HasSubstr(">second.mcap</text>"));
  EXPECT_THAT([&] { MakePage(first, second, 60, {}); },
              ThrowsMessage<RecordError>(HasSubstr("leaves nothing in common")));
}

TEST_F(PlotTest, MakesOneMarkOfACrowd) {
  std::vector<RecordedEvent> events;
  for (int i = 0; i < 5; ++i) {
    events.push_back({.time = 1 + 0.1 * i, .kind = "refused", .text = "refused 1 LowCmd (crc)"});
  }
  events.push_back({.time = 8, .kind = "refused", .text = "refused 1 LowCmd (gain)"});
  const PlotPage page = MakePage(McapReader(Rising(events)), {});
  ASSERT_THAT(page.marks, SizeIs(2));
  EXPECT_EQ(page.marks[0].times, 5);
  EXPECT_EQ(page.marks[1].text, "refused 1 LowCmd (gain)");
}

TEST_F(PlotTest, EscapesWhatTheFileSays) {
  const std::vector<RecordedEvent> events{
      {.time = 1, .kind = "push", .text = "<script>alert('x' & \"y\")</script>\n\x01"}};
  const std::string svg = DrawPage(MakePage(McapReader(Rising(events)), {}));
  EXPECT_THAT(svg, HasSubstr("&lt;script&gt;alert('x' &amp; &quot;y&quot;)&lt;/script&gt;"));
  EXPECT_THAT(svg, Not(HasSubstr("<script")));
  EXPECT_THAT(svg, Not(HasSubstr("\x01")));
}

// A refusal stands out from what was ordered, and both from the rest.
TEST_F(PlotTest, ColoursMarksByTheirKind) {
  const std::vector<RecordedEvent> events{{.time = 1, .kind = "refused", .text = "no"},
                                          {.time = 4, .kind = "push", .text = "go"},
                                          {.time = 8, .kind = "crane", .text = "hangs"}};
  const std::string svg = DrawPage(MakePage(McapReader(Rising(events)), {}));
  for (const char* text : {"mark bad\" x=", "mark asked\" x=", "mark told\" x="}) {
    EXPECT_THAT(svg, HasSubstr(text));
  }
}

TEST_F(PlotTest, NamesTheNearestWord) {
  const McapReader reader(Rising());
  EXPECT_THAT([&] { MakePage(reader, {.what = {.motors = {"FR_clf"}}}); },
              ThrowsMessage<RecordError>(HasSubstr("--motors: no motor 'FR_clf'")));
  EXPECT_THAT([&] { MakePage(reader, {.what = {.fields = {"ta"}}}); },
              ThrowsMessage<RecordError>(HasSubstr("did you mean 'tau'?")));
  EXPECT_THAT([&] { MakePage(reader, {.what = {.signals = {"understudy/truth:time"}}}); },
              ThrowsMessage<RecordError>(HasSubstr("--signals: no topic 'understudy/truth'")));
  EXPECT_THAT([&] { MakePage(reader, {.what = {.signals = {"tick"}}}); },
              ThrowsMessage<RecordError>(HasSubstr("expected TOPIC:FIELD")));
}

TEST_F(PlotTest, LeavesThePictureOfBeforeWhereThereIsNoNewOne) {
  std::filesystem::create_directories(File("a.svg") / "b");
  EXPECT_THAT([&] { WritePicture(MakePage(McapReader(Rising()), {}), File("a.svg")); },
              ThrowsMessage<RecordError>(HasSubstr("cannot be written")));
  for (const auto& entry : std::filesystem::directory_iterator(folder_.path())) {
    EXPECT_NE(entry.path().extension(), ".part");
  }
}

TEST_F(PlotTest, WantsAPictureThatItCanDraw) {
  EXPECT_THAT([&] { WritePicture(MakePage(McapReader(Rising()), {}), File("a.gif")); },
              ThrowsMessage<RecordError>(HasSubstr("expected a name that ends in .svg or .csv")));
}

}  // namespace
}  // namespace understudy::record
