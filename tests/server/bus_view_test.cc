#include "server/bus_view.h"

#include <nlohmann/json.hpp>

#include "bus/writer.h"
#include "gtest/gtest.h"
#include "idl/std_msgs.h"
#include "tests/support/new_domain.h"

namespace understudy::server {
namespace {

using bus::Endpoint;
using nlohmann::ordered_json;

constexpr bus::ParticipantKey kUs{1}, kThem{2};

Endpoint Ours(bool writes, const std::string& type) {
  return {.topic = "rt/lowstate",
          .ours = true,
          .writes = writes,
          .reliable = writes,
          .who = {.participant = kUs, .type = type}};
}
Endpoint Theirs(bool writes, const std::string& type) {
  return {.topic = "rt/lowstate",
          .writes = writes,
          .who = {.participant = kThem, .type = type, .process = "python3", .pid = "12"}};
}

TEST(BusJsonTest, TellsWhoReadsAndWritesATopicAndHowMuchWentOverIt) {
  const ordered_json told = BusJson({Ours(true, "A"), Theirs(false, "A")},
                                    {{"rt/lowstate", {.sent = 7, .received = 2}}}, 1.5);
  EXPECT_EQ(told["at"], 1.5);
  ASSERT_EQ(told["topics"].size(), 1u);
  const ordered_json& topic = told["topics"][0];
  EXPECT_EQ(topic["topic"], "rt/lowstate");
  EXPECT_EQ(topic["sent"], 7);
  EXPECT_EQ(topic["received"], 2);
  EXPECT_EQ(topic["endpoints"][0]["who"], "this robot");
  EXPECT_EQ(topic["endpoints"][0]["writes"], true);
  EXPECT_EQ(topic["endpoints"][0]["reliable"], true);
  EXPECT_EQ(topic["endpoints"][1]["who"], "process 12 (python3)");
  EXPECT_EQ(topic["endpoints"][1]["type"], "A");
  EXPECT_TRUE(topic["mismatches"].empty());
}

TEST(BusJsonTest, TellsBetweenWhomNothingPassesAndWhy) {
  const ordered_json topic = BusJson({Ours(true, "A"), Theirs(false, "B")}, {}, 0)["topics"][0];
  ASSERT_EQ(topic["mismatches"].size(), 1u);
  const ordered_json& mismatch = topic["mismatches"][0];
  EXPECT_EQ(mismatch["writer"], "this robot");
  EXPECT_EQ(mismatch["reader"], "process 12 (python3)");
  EXPECT_EQ(mismatch["why"], "type A, not B");
}

TEST(BusJsonTest, SaysWhoWouldServeWhatNobodyHereDoes) {
  Endpoint waits = Theirs(false, "A");
  waits.topic = "rt/utlidar/cloud";
  const ordered_json topics = BusJson({Ours(true, "A"), waits}, {}, 0)["topics"];
  EXPECT_EQ(topics[0]["unserved"], "");
  EXPECT_EQ(topics[1]["unserved"],
            "the lidar of a Go2; what of it is simulated is in docs/seeing.md");
}

// A robot listens for others of both families.
TEST(BusJsonTest, AReaderOfAnotherTypeIsNoMismatchBesideOneThatMatches) {
  const ordered_json topic =
      BusJson({Ours(false, "B"), Ours(false, "A"), Theirs(true, "A")}, {}, 0)["topics"][0];
  EXPECT_TRUE(topic["mismatches"].empty());
}

TEST(BusJsonTest, NobodyMismatchesItself) {
  EXPECT_TRUE(
      BusJson({Ours(true, "A"), Ours(false, "B")}, {}, 0)["topics"][0]["mismatches"].empty());
}

TEST(BusViewTest, TellsOfTheBusAndNoOftenerThanEachQuarterOfASecond) {
  const bus::Participant participant("lo", test::NewDomain());
  BusView dut(&participant);
  using Time = std::chrono::milliseconds;
  EXPECT_TRUE(ordered_json::parse(dut.Get(Time(1000)).body)["topics"].empty());
  const bus::Writer<std_msgs_msg_dds__String_> writer(participant,
                                                      {"rt/new", &std_msgs_msg_dds__String__desc});
  EXPECT_TRUE(ordered_json::parse(dut.Get(Time(1240)).body)["topics"].empty());
  const auto later = ordered_json::parse(dut.Get(Time(1250)).body);
  EXPECT_EQ(later["at"], 1.25);
  ASSERT_EQ(later["topics"].size(), 1u);
  EXPECT_EQ(later["topics"][0]["topic"], "rt/new");
}

TEST(BusViewTest, WithoutABusThereIsNone) { EXPECT_EQ(BusView().Get().status, 404u); }

}  // namespace
}  // namespace understudy::server
