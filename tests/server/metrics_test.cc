#include "server/metrics.h"

#include <cmath>
#include <set>
#include <sstream>

#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

class MetricsTest : public ::testing::Test {
 protected:
  MetricsTest() {
    snapshot_.motor_names = {"hip", "kn\"ee"};
    snapshot_.motors.resize(2);
    snapshot_.command_topics = {"rt/lowcmd", "rt/arm_sdk", "", "", "rt/dex3/left/cmd"};
  }
  std::string Dut() const {
    EventHistory events(&ring_);
    events.Update(std::chrono::nanoseconds(0));
    return MetricsText({.robot = "g1", .name = name_, .version = "0.1"}, status_, snapshot_,
                       events);
  }

  std::string name_;

  emulator::Status status_;
  emulator::Snapshot snapshot_;
  emulator::EventRing ring_;
};

TEST_F(MetricsTest, EachSampleOfOneOfSeveralRobotsNamesIt) {
  name_ = "left";
  const std::string text = Dut();
  EXPECT_THAT(text, HasSubstr("info{robot=\"left\",type=\"g1\",version=\"0.1\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("steps_total{robot=\"left\"} "));
  EXPECT_THAT(text, HasSubstr("events_total{robot=\"left\",kind="));
}

TEST_F(MetricsTest, CountsEventsByKind) {
  for (int i = 0; i < 7; ++i) ring_.Add(emulator::EventKind::kClamp);
  EXPECT_THAT(Dut(), testing::HasSubstr("\nunderstudy_events_total{kind=\"clamp\"} 7\n"));
}

TEST_F(MetricsTest, NamesThePolicyOfAWriterThatDoesNotMatch) {
  ring_.Add(emulator::EventKind::kUnmatched, 0, {}, "rt/lowcmd by process 7 (a): ownership");
  EXPECT_THAT(Dut(), HasSubstr("\nunderstudy_unmatched_writers_total{writer=\"rt/lowcmd by process "
                               "7 (a): ownership\"} 1\n"));
}

TEST_F(MetricsTest, StaysUtf8WhateverAWriterIsCalled) {
  ring_.Add(emulator::EventKind::kUnmatched, 0, {}, "rt/lowcmd by process 7 (\xff\xfe): ownership");
  EXPECT_THAT(Dut(), HasSubstr("rt/lowcmd by process 7 (?"
                               "?): ownership"));
}

TEST_F(MetricsTest, TellsCommandsByTopicAndReason) {
  status_.commands.accepted = 7;
  status_.commands.refused[static_cast<std::size_t>(robot::Refusal::kCrc)] = 5;
  status_.hands[0].commands.accepted = 3;
  status_.arm_commands.accepted = 4;
  const std::string text = Dut();
  EXPECT_THAT(text, HasSubstr("understudy_commands_taken_total{topic=\"rt/lowcmd\"} 7\n"));
  EXPECT_THAT(text, HasSubstr("understudy_commands_taken_total{topic=\"rt/arm_sdk\"} 4\n"));
  EXPECT_THAT(text, Not(HasSubstr("{topic=\"\"")));
  EXPECT_THAT(text, HasSubstr("understudy_commands_taken_total{topic=\"rt/dex3/left/cmd\"} 3\n"));
  EXPECT_THAT(text, HasSubstr("understudy_commands_refused_total{topic=\"rt/lowcmd\","
                              "reason=\"crc\"} 5\n"));
}

TEST_F(MetricsTest, TellsRefusedCallsByReason) {
  status_.services.refused[static_cast<std::size_t>(services::CallRefusal::kTooMany)] = 5;
  EXPECT_THAT(Dut(), HasSubstr("\nunderstudy_service_refusals_total{reason=\"too_many\"} 5\n"));
}

TEST_F(MetricsTest, BucketsAddUpToTheCount) {
  for (const double late : {1e-6, 3e-5, 3e-5, 9.0}) status_.loop.pace.latenesses.Add(late);
  const std::string text = Dut();
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_bucket{le=\"5e-06\"} 1\n"));
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_bucket{le=\"5e-05\"} 3\n"));
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_bucket{le=\"0.2\"} 3\n"));
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_bucket{le=\"+Inf\"} 4\n"));
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_count 4\n"));
  EXPECT_THAT(text, HasSubstr("understudy_lateness_seconds_sum 9.00006"));
}

TEST_F(MetricsTest, TellsMotorsByTheirJoints) {
  snapshot_.motors[0] = {.tau = -2.5, .casing_c = 40, .winding_c = 50.5};
  const std::string text = Dut();
  EXPECT_THAT(text, HasSubstr("understudy_motor_torque_newton_metres{motor=\"hip\"} -2.5\n"));
  EXPECT_THAT(text, HasSubstr("understudy_motor_winding_celsius{motor=\"hip\"} 50.5\n"));
  EXPECT_THAT(text, HasSubstr("{motor=\"kn\\\"ee\"}"));
}

TEST_F(MetricsTest, WhatIsNoNumberIsSaidInTheFormatsWords) {
  snapshot_.battery = {.voltage = std::nan(""), .current = -INFINITY};
  const std::string text = Dut();
  EXPECT_THAT(text, HasSubstr("understudy_battery_volts NaN\n"));
  EXPECT_THAT(text, HasSubstr("understudy_battery_amperes -Inf\n"));
}

TEST_F(MetricsTest, EveryFamilyHasOneHelpOneTypeAndItsSamplesBelow) {
  std::istringstream lines(Dut());
  std::set<std::string> seen;
  std::string family;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string first;
    std::string kind;
    std::string name;
    words >> first;
    if (first != "#") {
      EXPECT_TRUE(line.starts_with(family)) << line;
      continue;
    }
    words >> kind >> name;
    if (kind == "HELP") {
      EXPECT_TRUE(seen.insert(name).second) << name;
      family = name;
    } else {
      EXPECT_EQ(kind, "TYPE");
      EXPECT_EQ(name, family);
      std::string type;
      words >> type;
      EXPECT_EQ(type == "counter", name.ends_with("_total")) << name;
    }
  }
  EXPECT_GT(seen.size(), 15u);
}

}  // namespace
}  // namespace understudy::server
