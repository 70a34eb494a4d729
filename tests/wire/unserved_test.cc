#include "wire/unserved.h"

#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/std_msgs.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"
#include "wire/robot_topics.h"
#include "wire/who_serves.h"

namespace understudy::wire {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

bus::Endpoint Theirs(const std::string& topic, bool writes) {
  return {.topic = topic, .writes = writes, .who = {.process = "python3", .pid = "12"}};
}

std::vector<std::string> Told(const std::vector<bus::Endpoint>& endpoints) {
  std::vector<std::string> told;
  for (const Unserved& one : UnservedIn(endpoints)) {
    told.push_back((one.reads ? "reads " : "writes ") + one.topic + " " + one.who.pid);
  }
  return told;
}

TEST(UnservedTest, NamesWhatIsReadAndWrittenByNobodyOnce) {
  EXPECT_THAT(Told({Theirs("rt/utlidar/cloud", false), Theirs("rt/utlidar/cloud", false),
                    Theirs("rt/my_map", false), Theirs("lowstate", false)}),
              ElementsAre("reads rt/utlidar/cloud 12", "reads rt/my_map 12", "reads lowstate 12"));
}

TEST(UnservedTest, NamesWhatIsWrittenForNobodyIfItIsARobots) {
  EXPECT_THAT(Told({Theirs("rt/dex1/left/cmd", true), Theirs("rt/my_map", true)}),
              ElementsAre("writes rt/dex1/left/cmd 12"));
}

TEST(UnservedTest, NamesNothingThatARobotPublishesForNobodyOrIsCommandedBy) {
  for (const TopicName& one : VendorTopics()) {
    const bool is_command = one.type.find("Cmd") != std::string_view::npos ||
                            one.type.find("ctrl") != std::string_view::npos ||
                            one.name.ends_with("switch");
    const std::string name(one.name);
    EXPECT_THAT(Told({Theirs(name, true)}), SizeIs(is_command ? 1 : 0)) << name;
    EXPECT_THAT(Told({Theirs(name, false)}), SizeIs(is_command ? 0 : 1)) << name;
  }
  EXPECT_THAT(
      Told({Theirs("rt/api/sport/request", true), Theirs("rt/api/vui/request", false),
            Theirs("rt/api/motion_switcher/response", true), Theirs("rt/api/bms/response", false)}),
      ElementsAre("writes rt/api/sport/request 12", "reads rt/api/bms/response 12"));
}

TEST(UnservedTest, LeavesOutWhatHasBothEndsWhoeverHasThem) {
  bus::Endpoint ours = Theirs("rt/lowstate", true);
  ours.ours = true;
  EXPECT_THAT(Told({ours, Theirs("rt/lowstate", false), Theirs("rt/my_map", true),
                    Theirs("rt/my_map", false), Theirs("ros_discovery_info", false)}),
              IsEmpty());
  EXPECT_THAT(Told({ours}), IsEmpty()) << "what a robot writes needs no reader";
}

TEST(UnservedTest, SaysWhoServesATopic) {
  EXPECT_THAT(WhoWouldSend("rt/utlidar/cloud"), HasSubstr("lidar"));
  EXPECT_THAT(WhoWouldSend("rt/dex1/left/state"), HasSubstr("run g1 --hands dex1"));
  EXPECT_THAT(WhoWouldSend("rt/unitree_actuator/state"), HasSubstr("--hands dex1_old"));
  EXPECT_THAT(WhoWouldSend("rt/hand_sdk"), HasSubstr("run g1 --hands dex1"));
  EXPECT_THAT(WhoWouldSend("rt/api/loco/request"), HasSubstr("service that this robot"));
  EXPECT_THAT(WhoWouldSend("rt/secondary_imu"), HasSubstr("another kind"));
  EXPECT_THAT(WhoWouldSend("lowstate"), HasSubstr("the name rt/lowstate on DDS"));
  EXPECT_THAT(WhoWouldSend("rt/lowsate"), HasSubstr("did you mean 'rt/lowstate'?"));
}

TEST(UnservedWatchTest, TellsOnceAfterAWhile) {
  const int domain = test::NewDomain();
  const bus::Participant robot("lo", domain), program("lo", domain);
  UnservedWatch watch(robot);
  const bus::Reader waits(program, bus::Topic<std_msgs_msg_dds__String_>{
                                       "rt/gas_sensor", &std_msgs_msg_dds__String__desc});
  bus::EndpointSurvey survey(robot);
  ASSERT_TRUE(test::Eventually([&] {
    survey.Poll();
    return !survey.endpoints().empty();
  }));
  using std::chrono::seconds;
  EXPECT_THAT(watch.Poll(seconds(1)), IsEmpty());
  EXPECT_THAT(watch.Poll(seconds(3)), IsEmpty());
  const std::vector<Unserved> told = watch.Poll(seconds(4));
  ASSERT_EQ(told.size(), 1U);
  EXPECT_EQ(told[0].topic, "rt/gas_sensor");
  EXPECT_THAT(watch.Poll(seconds(20)), IsEmpty());
}

}  // namespace
}  // namespace understudy::wire
