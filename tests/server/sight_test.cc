#include "server/sight.h"

#include <cstring>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "idl/type_table.h"
#include "tests/support/eventually.h"
#include "tests/support/lidar_messages.h"
#include "tests/support/new_domain.h"

namespace understudy::server {
namespace {

using ::testing::ElementsAre;
using ::testing::FloatNear;
using ::testing::HasSubstr;
using ::testing::Pointwise;

robot::RobotSpec Robot(const std::string& make) {
  robot::RobotSpec spec;
  spec.base_body = "trunk";
  spec.lidar.make = make;
  spec.lidar.pos = {0, 0, 1};
  spec.lidar.rpy = {3.14159265358979, 0, 0};  // hangs upside down
  return spec;
}

// A robot that publishes what the test has it say.
class SightTest : public ::testing::Test {
 protected:
  bus::CdrWriter Writer(const std::string& topic, const char* type) {
    return {participant_, topic, *FindMessageType(type)->descriptor};
  }
  // Returns the numbers of the view once there are some.
  std::vector<float> Seen(Sight* dut, std::string_view name) {
    HttpReply reply;
    EXPECT_TRUE(test::Eventually([&] { return !(reply = dut->Get(name)).body.empty(); }));
    EXPECT_EQ(reply.status, 200u);
    std::vector<float> numbers(reply.body.size() / sizeof(float));
    std::memcpy(numbers.data(), reply.body.data(), reply.body.size());
    return numbers;
  }

  bus::Participant participant_{"lo", test::NewDomain()};
};

TEST_F(SightTest, ListsTheViewsAndTheBodiesInWhoseFrameTheyAre) {
  robot::RobotSpec g1 = Robot("Mid-360");
  g1.lidar.body = "torso";
  const auto told = nlohmann::json::parse(Sight(&participant_, g1).List().body);
  EXPECT_EQ(told, nlohmann::json::parse(
                      R"({"make": "Mid-360", "views": [{"name": "cloud", "body": "torso"}]})"));
  const auto go2 = nlohmann::json::parse(Sight(&participant_, Robot("L1")).List().body);
  EXPECT_EQ(go2["views"][1]["name"], "heights");
  EXPECT_EQ(go2["views"][1]["body"], "trunk");
}

TEST_F(SightTest, ShowsTheNewestCloudInTheFrameOfTheBody) {
  Sight dut(&participant_, Robot("L1"));
  EXPECT_EQ(dut.Get("cloud").status, 200u);
  EXPECT_EQ(dut.Get("cloud").body, "");
  auto writer = Writer("rt/utlidar/cloud", "sensor_msgs::msg::dds_::PointCloud2_");
  EXPECT_TRUE(test::Eventually([&] { return writer.matched_readers() == 1; }));
  writer.Write(test::CloudMessage({.points = {{9, 9, 9}}}).span());
  writer.Write(test::CloudMessage({.points = {{1, 2, 3}}}).span());
  EXPECT_THAT(Seen(&dut, "cloud"), Pointwise(FloatNear(1e-5F), {1.F, -2.F, -2.F}));
}

TEST_F(SightTest, ShowsTheHeightsAroundTheBase) {
  Sight dut(&participant_, Robot("L1"));
  dut.Get("heights");
  auto heights = Writer("rt/utlidar/height_map_array", "unitree_go::msg::dds_::HeightMap_");
  auto pose = Writer("rt/utlidar/robot_pose", "geometry_msgs::msg::dds_::PoseStamped_");
  EXPECT_TRUE(test::Eventually(
      [&] { return heights.matched_readers() == 1 && pose.matched_readers() == 1; }));
  heights.Write(test::HeightMapMessage(1, 1, {0.5F}).span());
  EXPECT_EQ(dut.Get("heights").body, "");  // where the robot is is not known yet
  pose.Write(test::PoseMessage({0, 2, 0.25, 0, 0, 1, 0}).span());  // faces back
  EXPECT_THAT(Seen(&dut, "heights"), Pointwise(FloatNear(1e-5F), {-1.F, 0.F, 0.25F}));
}

TEST_F(SightTest, ReadsNothingBeforeTheFirstQuestionAndSoonAfterTheLast) {
  Sight dut(&participant_, Robot("L1"));
  EXPECT_FALSE(dut.reads());
  const Sight::Clock::time_point now{std::chrono::hours(1)};
  dut.Get("cloud", now);
  dut.Rest(now + Sight::kLapse - std::chrono::milliseconds(1));
  EXPECT_TRUE(dut.reads());
  dut.Rest(now + Sight::kLapse);
  EXPECT_FALSE(dut.reads());
}

TEST_F(SightTest, NamesTheNearestViewOfOneThatItHasNot) {
  Sight dut(&participant_, Robot("L1"));
  EXPECT_EQ(dut.Get("clod").status, 404u);
  EXPECT_THAT(dut.Get("clod").body, HasSubstr("did you mean 'cloud'?"));
  EXPECT_THAT(Sight(&participant_, Robot("none")).Get("cloud").body, HasSubstr("has no lidar"));
  EXPECT_THAT(Sight().Get("cloud").body, HasSubstr("has no lidar"));
}

}  // namespace
}  // namespace understudy::server
