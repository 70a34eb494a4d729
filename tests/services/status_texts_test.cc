#include "services/status_texts.h"

#include <map>
#include <memory>
#include <string>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "bus/participant.h"
#include "bus/reader.h"
#include "config/load.h"
#include "services/robot_services.h"
#include "tests/services/services_fixture.h"
#include "tests/support/new_domain.h"

namespace understudy::services {
namespace {

using nlohmann::json;
using testing::ElementsAre;

using String = std_msgs_msg_dds__String_;

// Readers and writers of one participant match at once.
class StatusTextsTest : public testing::Test {
 protected:
  StatusTextsTest() {
    for (const char* service : {"obstacles_avoid", "vui", "uwbswitch"}) {
      services_.push_back(std::make_unique<Service>(TableOf("go2", service)));
    }
    const std::vector<wire::RobotTopic> topics =
        wire::ServiceTopics({}, {"rt/rtc/state", "rt/multiplestate", "rt/audiohub/player/state"});
    texts_.emplace(&outlets_, topics, services_);
    for (const char* topic :
         {"rt/rtc/state", "rt/multiplestate", "rt/audiohub/player/state", "rt/servicestate"}) {
      readers_.try_emplace(topic, participant_,
                           bus::Topic<String>{topic, &std_msgs_msg_dds__String__desc},
                           bus::ReaderOptions{.depth = 100});
    }
  }

  // Tells in steps of 10 ms from where it ended to `until` [s].
  void TellTo(double until) {
    for (; t_ < until - 1e-9; t_ += 0.01) texts_->Tell(owner_, t_);
  }
  std::vector<std::string> Heard(const std::string& topic) {
    std::vector<std::string> texts;
    const auto hear = [&](const String& message, bus::WriterHandle) {
      texts.emplace_back(message.data);
    };
    while (readers_.at(topic).Take(hear) > 0) continue;
    return texts;
  }

  bus::Participant participant_{"lo", test::NewDomain()};
  wire::Outlets outlets_{participant_, 0.001};
  std::vector<std::unique_ptr<Service>> services_;
  MotionBook book_;
  authority::MotorOwner owner_{{{.name = "ai_sport", .alias = "ai", .version = "8.5.1.1"},
                                {.name = "ota_box", .on = false},
                                {.name = "basic_service", .is_protected = true}},
                               "0",
                               Plays(&book_)};
  std::optional<StatusTexts> texts_;
  std::map<std::string, bus::Reader<String>> readers_;
  double t_ = 0;
};

TEST_F(StatusTextsTest, SpeakAllTheTimeAtTheRatesThatWereSeen) {
  TellTo(10);
  EXPECT_EQ(Heard("rt/rtc/state").size(), 10U);
  EXPECT_EQ(Heard("rt/multiplestate").size(), 10U);
  EXPECT_EQ(Heard("rt/audiohub/player/state").size(), 40U);
}

TEST_F(StatusTextsTest, LeaveOutWhatASilencedRobotDidNotSay) {
  TellTo(0.5);
  t_ = 20.5;
  TellTo(21.5);
  EXPECT_EQ(Heard("rt/rtc/state").size(), 3U) << "at 0, 20.5 and 21 s";
}

TEST_F(StatusTextsTest, SayWhatRealRobotsSay) {
  TellTo(0.1);
  EXPECT_THAT(Heard("rt/rtc/state"), ElementsAre(R"({"connection_state":"not_connected"})"));
  EXPECT_THAT(Heard("rt/audiohub/player/state"),
              ElementsAre(R"({"is_playing":false,"play_state":"not_in_use"})"));
}

TEST_F(StatusTextsTest, TellTheSettingsOfTheServices) {
  TellTo(0.5);
  EXPECT_THAT(
      Heard("rt/multiplestate"),
      ElementsAre(R"({"brightness":5,"obstaclesAvoidSwitch":false,"uwbSwitch":false,"volume":5})"));
  services_[0]->Set("enable", true);
  services_[1]->Set("volume", 7);
  services_[2]->Set("enable", 1);
  TellTo(1.5);
  EXPECT_THAT(
      Heard("rt/multiplestate"),
      ElementsAre(R"({"brightness":5,"obstaclesAvoidSwitch":true,"uwbSwitch":true,"volume":7})"));
}

TEST_F(StatusTextsTest, ReportTheProgramsOnlyOnceItWasAskedFor) {
  TellTo(6);
  EXPECT_THAT(Heard("rt/servicestate"), ElementsAre());
  owner_.onboard().RequestReport(5, 0);
  TellTo(17);
  const std::vector<std::string> texts = Heard("rt/servicestate");
  ASSERT_EQ(texts.size(), 3U) << "at 6, 11 and 16 s";
  EXPECT_EQ(json::parse(texts[0]), json::parse(R"([
      {"name":"ai_sport","protect":0,"status":0,"version":"8.5.1.1"},
      {"name":"ota_box","protect":0,"status":1},
      {"name":"basic_service","protect":1,"status":0}])"));
}

TEST_F(StatusTextsTest, EndReportsAfterTheirTimeAndWhenTold) {
  owner_.onboard().RequestReport(1, 3);
  TellTo(10);
  EXPECT_EQ(Heard("rt/servicestate").size(), 4U) << "at 0, 1, 2 and 3 s";
  owner_.onboard().RequestReport(1, 0);
  TellTo(12.5);
  owner_.onboard().RequestReport(0, 0);
  TellTo(20);
  EXPECT_EQ(Heard("rt/servicestate").size(), 3U) << "at 10, 11 and 12 s";
}

TEST_F(StatusTextsTest, KnowTheTopicsOfTheirRobotsOnly) {
  for (const std::string robot : {"go2", "g1"}) {
    const auto spec = config::LoadConfig({.robot = robot}, UNDERSTUDY_SOURCE_DIR).robots[0].spec;
    EXPECT_NO_THROW(wire::ServiceTopics({}, spec.status_texts)) << robot;
    EXPECT_FALSE(spec.status_texts.empty());
  }
  try {
    wire::ServiceTopics({}, {"rt/gns"});
    ADD_FAILURE();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("did you mean 'rt/gnss'?"));
  }
}

TEST_F(StatusTextsTest, HaveATextForEachTopic) {
  std::vector<std::string> all;
  for (const wire::StatusTextTopic& one : wire::kStatusTexts) all.emplace_back(one.topic.name);
  wire::Outlets outlets(participant_, 0.001);
  StatusTexts texts(&outlets, wire::ServiceTopics({}, all), services_);
  std::map<std::string, bus::Reader<String>> readers;
  for (const std::string& topic : all) {
    readers.try_emplace(topic, participant_,
                        bus::Topic<String>{topic.c_str(), &std_msgs_msg_dds__String__desc});
  }
  texts.Tell(owner_, 0);
  for (auto& [topic, reader] : readers) {
    EXPECT_GT(reader.Take([](const String&, bus::WriterHandle) {}), 0) << topic;
  }
}

TEST_F(StatusTextsTest, AreLostWhereTheirLinkLosesThem) {
  const std::vector<robot::LinkEffects> links(outlets_.size(), {.drops = true});
  outlets_.BeginTick(0, links);
  TellTo(2);
  EXPECT_THAT(Heard("rt/rtc/state"), ElementsAre());
  outlets_.BeginTick(2, {});
  TellTo(3);
  EXPECT_EQ(Heard("rt/rtc/state").size(), 1U);
}

}  // namespace
}  // namespace understudy::services
