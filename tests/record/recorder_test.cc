#include "record/recorder.h"

#include <csignal>
#include <list>
#include <map>
#include <string>

#include <gmock/gmock.h>
#include <sys/resource.h>

#include "bus/writer.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "tests/bus/stranger.h"
#include "tests/record/mcap_files.h"
#include "tests/support/allocations.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::record {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;
using ::testing::StartsWith;

constexpr bus::Topic<bus::Hello> kHello{"rt/hello", &HelloWorldData_Msg_desc};

class RecorderTest : public McapFilesTest {
 protected:
  std::unique_ptr<Recorder> Start(const bus::Participant& participant,
                                  const std::filesystem::path& file, std::int64_t first_step = 0,
                                  std::optional<RosRobot> ros = {},
                                  std::optional<std::uint64_t> start = {}) {
    const RecordingHead head{.about = {{"robot", "go2"}},
                             .config = "robot: {}\n",
                             .model = {},
                             .ros = std::move(ros),
                             .start = start};
    const Moment moment{.truth = {.qpos = {0, 0}}};
    return std::make_unique<Recorder>(participant, OutputFile(file, true), head, &ring_, moment,
                                      std::chrono::milliseconds(1), first_step,
                                      [this](const std::string& line, bool) {
                                        const std::lock_guard lock(mutex_);
                                        said_.push_back(line);
                                      });
  }
  std::vector<std::string> said() {
    const std::lock_guard lock(mutex_);
    return said_;
  }
  // The tick of one step, which sends a greeting with its number.
  static void Tick(Recorder* recorder, bus::Writer<bus::Hello>* writer, std::int64_t step) {
    std::string text = "hello";
    ASSERT_TRUE(writer->Write({.userID = step, .message = text.data()}));
    recorder->Mark(step);
    if (Moment* moment = recorder->Claim(); moment != nullptr) {
      moment->truth.step = step + 1;
      moment->truth.time = static_cast<double>(step + 1) * 1e-3;
      recorder->Commit();
    }
  }
  // In ms since the start, by topic.
  std::map<std::string, std::vector<std::uint64_t>> Times(const McapReader& reader) {
    const std::uint64_t start =
        std::stoull(reader.contents().metadata.at("understudy").at("start_time_ns"));
    std::map<std::string, std::vector<std::uint64_t>> times;
    for (const Kept& message : MessagesOf(reader)) {
      times[message.topic].push_back((message.log_time - start) / 1'000'000);
    }
    return times;
  }
  static std::int64_t IdOf(const Kept& message) {
    std::int64_t id = 0;
    std::memcpy(&id, message.data.data() + 4, sizeof(id));
    return id;
  }

  // A refused command of a step.
  void Refuse(std::int64_t step) {
    emulator::Event event{.step = step,
                          .time = static_cast<double>(step) * 1e-3,
                          .kind = emulator::EventKind::kRefused,
                          .numbers = {static_cast<double>(robot::Refusal::kCrc)}};
    emulator::CopyText("rt/lowcmd", &event.text);
    ring_.Append(event);
  }
  static std::vector<RecordedEvent> EventsOf(const McapReader& reader) {
    std::vector<RecordedEvent> events;
    reader.ReadMessages([&](const McapChannel& channel, const McapMessage& message) {
      if (channel.topic == kEventTopic) events.push_back(DecodeEvent(message.data));
      return true;
    });
    return events;
  }

 private:
  emulator::EventRing ring_;
  std::mutex mutex_;
  std::vector<std::string> said_;
};

TEST_F(RecorderTest, BeginsWhenTheHeadSays) {
  const bus::Participant ours("lo", test::NewDomain());
  const auto file = folder_.path() / "again.mcap";
  Start(ours, file, 0, {}, 1'767'225'600'000'000'000).reset();
  const McapReader reader(file);
  EXPECT_EQ(reader.contents().metadata.at("understudy").at("start_time_ns"), "1767225600000000000");
}

TEST_F(RecorderTest, KeepsEveryMessageAtItsStep) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  auto recorder = Start(ours, File());
  for (std::int64_t step = 0; step < 20'000; ++step) {
    Tick(recorder.get(), &writer, step);
    while (recorder->behind()) std::this_thread::yield();
  }
  EXPECT_EQ(recorder->status().dropped, 0U);
  recorder.reset();
  const McapReader reader(File());
  EXPECT_EQ(reader.contents().cut_short, "");
  std::int64_t expected = 0;
  const std::uint64_t start =
      std::stoull(reader.contents().metadata.at("understudy").at("start_time_ns"));
  for (const Kept& message : MessagesOf(reader)) {
    if (message.topic != "/hello") continue;
    ASSERT_EQ(IdOf(message), expected);
    ASSERT_EQ(message.log_time, start + static_cast<std::uint64_t>(expected) * 1'000'000);
    ++expected;
  }
  EXPECT_EQ(expected, 20'000);
  EXPECT_EQ(Times(reader).at("understudy/truth").size(), 20'000U);
  EXPECT_THAT(said(), IsEmpty());
}

TEST_F(RecorderTest, ThatBeginsInTheMiddleLeavesOutWhatWasBefore) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  Refuse(10);
  Refuse(1000);
  auto recorder = Start(ours, File(), 1000);
  for (std::int64_t step = 1000; step < 1010; ++step) Tick(recorder.get(), &writer, step);
  recorder.reset();
  const McapReader reader(File());
  const auto times = Times(reader);
  EXPECT_EQ(times.at("/hello").front(), 1000U);
  EXPECT_EQ(times.at("/hello").size(), 10U);
  EXPECT_EQ(times.at("understudy/truth").front(), 1001U);
  const std::vector<RecordedEvent> events = EventsOf(reader);
  ASSERT_EQ(events.size(), 1U);
  EXPECT_EQ(events[0].step, 1000);
}

TEST_F(RecorderTest, HasTopicsOfRosAtTheirRateAndWhatStaysOnceAtTheBegin) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  RosRobot robot;
  robot.tree.base = "base";
  robot.every = 20;
  auto recorder = Start(ours, File(), 1000, robot);
  for (std::int64_t step = 1000; step < 1050; ++step) Tick(recorder.get(), &writer, step);
  recorder.reset();
  const McapReader reader(File());
  const auto times = Times(reader);
  for (const char* topic : {"/tf", "/joint_states", "/clock"}) {
    EXPECT_THAT(times.at(topic), ElementsAre(1020, 1040)) << topic;
  }
  for (const char* topic : {"/tf_static", "/robot_description", "/scene"}) {
    EXPECT_THAT(times.at(topic), ElementsAre(1000)) << topic;
  }
  for (const auto& [id, channel] : reader.contents().channels) {
    if (channel.topic == "/hello") continue;
    EXPECT_EQ(channel.metadata.at("from"), "simulation") << channel.topic;
    const bool latched = times.contains(channel.topic) && times.at(channel.topic).size() == 1;
    EXPECT_THAT(channel.metadata.at("offered_qos_profiles"),
                HasSubstr(latched ? "durability: 1" : "durability: 2"))
        << channel.topic;
  }
}

TEST_F(RecorderTest, IsInOrderOfTime) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  auto recorder = Start(ours, File());
  for (std::int64_t step = 0; step < 2000; ++step) {
    Refuse(step);
    Tick(recorder.get(), &writer, step);
  }
  recorder.reset();
  std::uint64_t last = 0;
  for (const Kept& message : MessagesOf(McapReader(File()))) {
    EXPECT_GE(message.log_time, last);
    last = message.log_time;
  }
}

TEST_F(RecorderTest, TellsOfABurstOfEventsByItsCountAndOfItsEnd) {
  const bus::Participant ours("lo", 218);
  bus::Writer<bus::Hello> writer(ours, kHello);
  auto recorder = Start(ours, File());
  for (std::int64_t step = 0; step < 150; ++step) {
    Refuse(step);
    Tick(recorder.get(), &writer, step);
  }
  Refuse(150);
  recorder.reset();
  const std::vector<RecordedEvent> events = EventsOf(McapReader(File()));
  ASSERT_THAT(events, SizeIs(3));
  EXPECT_EQ(events[0].step, 0);
  EXPECT_EQ(events[0].kind, "refused");
  EXPECT_EQ(events[0].detail, R"({"count":1,"reason":"crc","topic":"rt/lowcmd"})");
  EXPECT_EQ(events[1].step, 100);
  EXPECT_EQ(events[1].detail, R"({"count":100,"reason":"crc","topic":"rt/lowcmd"})");
  EXPECT_EQ(events[2].detail, R"({"count":50,"reason":"crc","topic":"rt/lowcmd"})");
}

TEST_F(RecorderTest, TellsClientsFromTheRobot) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  bus::Writer<bus::Hello> writer(ours, kHello);
  auto recorder = Start(ours, File());
  const bus::Stranger stranger(domain);
  const bus::Entity theirs = stranger.Writes(kHello.name);
  std::string text = "hello";
  const bus::Hello hello{.userID = -1, .message = text.data()};
  ASSERT_EQ(dds_write(theirs.handle(), &hello), DDS_RETCODE_OK);
  Tick(recorder.get(), &writer, 0);
  recorder.reset();
  const McapReader reader(File());
  std::map<std::string, std::vector<std::int64_t>> by;
  reader.ReadMessages([&](const McapChannel& channel, const McapMessage& message) {
    if (channel.topic == "/hello") {
      by[channel.metadata.at("from")].push_back(IdOf({.topic = "",
                                                      .sequence = 0,
                                                      .log_time = 0,
                                                      .publish_time = 0,
                                                      .data = TextOf(message.data)}));
    }
    return true;
  });
  EXPECT_THAT(by["robot"], ElementsAre(0));
  EXPECT_THAT(by["client"], ElementsAre(-1));
}

TEST_F(RecorderTest, FindsTopicsThatComeLater) {
  const int domain = test::NewDomain();
  const bus::Participant ours("lo", domain);
  auto recorder = Start(ours, File());
  const bus::Stranger stranger(domain);
  const bus::Entity theirs = stranger.Writes("rt/later");
  std::string text = "hello";
  const bus::Hello hello{.userID = 5, .message = text.data()};
  // Until it is found nobody hears it.
  ASSERT_TRUE(test::Eventually([&] {
    dds_write(theirs.handle(), &hello);
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return dds_get_matched_subscriptions(theirs.handle(), nullptr, 0) == 1;
  }));
  ASSERT_EQ(dds_write(theirs.handle(), &hello), DDS_RETCODE_OK);
  recorder.reset();
  EXPECT_FALSE(Times(McapReader(File()))["/later"].empty());
}

// Nothing ticks: what comes belongs to the step that is next.
TEST_F(RecorderTest, GivesMessagesOfAPauseTheTimeOfThePause) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  auto recorder = Start(ours, File());
  for (std::int64_t step = 0; step < 3; ++step) Tick(recorder.get(), &writer, step);
  const std::uint64_t before = recorder->status().messages;
  std::string text = "hello";
  ASSERT_TRUE(writer.Write({.userID = 3, .message = text.data()}));
  ASSERT_TRUE(test::Eventually([&] { return recorder->status().messages >= before + 1; }));
  recorder.reset();
  EXPECT_THAT(Times(McapReader(File()))["/hello"], ElementsAre(0, 1, 2, 3));
}

TEST_F(RecorderTest, GoesOnWithoutAFileThatIsFull) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<bus::Hello> writer(ours, kHello);
  EXPECT_THROW(Start(ours, "/dev/full"), RecordError);

  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit few{.rlim_cur = 10'000, .rlim_max = before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &few);
  auto recorder = Start(ours, File());
  std::int64_t step = 0;
  EXPECT_TRUE(test::Eventually([&] {
    if (!recorder->behind()) Tick(recorder.get(), &writer, step++);
    return recorder->status().state == emulator::RecordingState::kFailed;
  }));
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_EQ(recorder->Claim(), nullptr);
  EXPECT_FALSE(recorder->behind());
  EXPECT_TRUE(test::Eventually([&] { return !said().empty(); }));
  recorder.reset();
  ASSERT_THAT(said(), SizeIs(1));
  EXPECT_THAT(said()[0], HasSubstr("File too large: recording has stopped; the robot continues"));
  const McapReader reader(File());  // what is there can be read
  EXPECT_EQ(reader.contents().metadata.at("understudy").at("robot"), "go2");
}

TEST_F(RecorderTest, SaysWhichTopicItCannotRecord) {
  const bus::Participant ours("lo", test::NewDomain());
  auto recorder = Start(ours, File());
  const dds_topic_descriptor& known = HelloWorldData_Msg_desc;
  const dds_topic_descriptor unknown{.m_size = known.m_size,
                                     .m_align = known.m_align,
                                     .m_flagset = 0,
                                     .m_nkeys = 0,
                                     .m_typename = "somebody::Else",
                                     .m_keys = nullptr,
                                     .m_nops = known.m_nops,
                                     .m_ops = known.m_ops,
                                     .m_meta = "",
                                     .type_information = {},
                                     .type_mapping = {},
                                     .restrict_data_representation = 0};
  std::list<bus::Entity> entities;
  const auto write = [&](const std::string& name) {
    const bus::Entity& topic = entities.emplace_back(
        dds_create_topic(ours.handle(), &unknown, name.c_str(), nullptr, nullptr), "topic");
    entities.emplace_back(dds_create_writer(ours.handle(), topic.handle(), nullptr, nullptr),
                          "writer");
  };
  write("rt/else");
  EXPECT_TRUE(test::Eventually([&] { return !said().empty(); }));
  EXPECT_THAT(said(), ElementsAre("topic rt/else is not recorded: its type somebody::Else is none "
                                  "of the vendor's"));
  // A stranger's hundreds are no hundreds of lines.
  for (int i = 0; i < 40; ++i) write("rt/else" + std::to_string(i));
  EXPECT_TRUE(test::Eventually([&] { return said().size() >= 9; }));
  recorder.reset();
  ASSERT_THAT(said(), SizeIs(9));
  EXPECT_THAT(said().back(), StartsWith("further topics"));
  while (!entities.empty()) entities.pop_back();  // a writer before its topic
}

TEST_F(RecorderTest, LeavesVideoToThoseWhoWatchIt) {
  const bus::Participant ours("lo", test::NewDomain());
  bus::Writer<unitree_go_msg_dds__Go2FrontVideoData_> video(
      ours, {"rt/video", &unitree_go_msg_dds__Go2FrontVideoData__desc});
  bus::Writer<bus::Hello> hello(ours, kHello);
  auto recorder = Start(ours, File());
  EXPECT_TRUE(test::Eventually([&] { return hello.has_readers(); }));
  EXPECT_FALSE(video.has_readers());
}

TEST_F(RecorderTest, AllocatesNothingInTheLoopsThread) {
  const bus::Participant ours("lo", test::NewDomain());
  auto recorder = Start(ours, "/dev/null");
  std::uint64_t counted = 0;
  for (std::int64_t step = 0; step < 1000; ++step) {
    const std::uint64_t before = test::AllocationsOfThisThread();
    recorder->Mark(step);
    if (Moment* moment = recorder->Claim(); moment != nullptr) {
      moment->truth.step = step + 1;
      moment->truth.qpos.assign(2, 1.0);
      recorder->Commit();
    }
    counted += test::AllocationsOfThisThread() - before;
  }
  EXPECT_EQ(counted, 0U);
}

}  // namespace
}  // namespace understudy::record
