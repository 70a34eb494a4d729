// Checks the publications of the robots in config/robots, and their rates.
#include <algorithm>
#include <cmath>
#include <deque>
#include <set>
#include <string>

#include <gmock/gmock.h>

#include "bus/cdr.h"
#include "bus/discovery.h"
#include "config/load.h"
#include "config/robot_file.h"
#include "robot/firmware.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"
#include "tests/wire/robots.h"
#include "wire/port.h"
#include "wire/robot_topics.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

struct Row {
  std::string topic;
  const dds_topic_descriptor* type;
  int hz;  // of simulated time
};

std::vector<Row> GoRows(const robot::RobotSpec& spec) {
  const int motion = robot::IsQuadruped(spec.kind) ? 300 : 500;
  const bool lidar = spec.name == "go2";
  const int livox = spec.name == "h1" ? 1 : 0;
  return {{"rt/lowstate", &unitree_go_msg_dds__LowState__desc, 500},
          {"rt/lf/lowstate", &unitree_go_msg_dds__LowState__desc, 20},
          {"rt/sportmodestate", &unitree_go_msg_dds__SportModeState__desc, motion},
          {"rt/lf/sportmodestate", &unitree_go_msg_dds__SportModeState__desc, 20},
          {"rt/wirelesscontroller", &unitree_go_msg_dds__WirelessController__desc, motion},
          // When it changes, here once.
          {"rt/errorlist", &std_msgs_msg_dds__String__desc, spec.error_list ? 1 : 0},
          {"rt/utlidar/robot_odom", &nav_msgs_msg_dds__Odometry__desc, lidar ? 150 : 0},
          {"rt/utlidar/robot_pose", &geometry_msgs_msg_dds__PoseStamped__desc,
           lidar ? 19 : 0},  // 18.75, from 0 on
          // When one is complete or due, here once.
          {"rt/utlidar/cloud", &sensor_msgs_msg_dds__PointCloud2__desc, lidar ? 1 : 0},
          {"rt/utlidar/cloud_base", &sensor_msgs_msg_dds__PointCloud2__desc, lidar ? 1 : 0},
          {"rt/utlidar/cloud_deskewed", &sensor_msgs_msg_dds__PointCloud2__desc, lidar ? 1 : 0},
          {"rt/utlidar/imu", &sensor_msgs_msg_dds__Imu__desc, lidar ? 1 : 0},
          {"rt/utlidar/lidar_state", &unitree_go_msg_dds__LidarState__desc, lidar ? 1 : 0},
          {"rt/utlidar/range_info", &geometry_msgs_msg_dds__PointStamped__desc, lidar ? 1 : 0},
          {"rt/utlidar/height_map_array", &unitree_go_msg_dds__HeightMap__desc, lidar ? 1 : 0},
          {"rt/utlidar/voxel_map_compressed", &unitree_go_msg_dds__VoxelMapCompressed__desc,
           lidar ? 1 : 0},
          {"rt/utlidar/map_state", &unitree_go_msg_dds__VoxelHeightMapState__desc, lidar ? 1 : 0},
          {"rt/utlidar/cloud_livox_mid360", &sensor_msgs_msg_dds__PointCloud2__desc, livox},
          {"rt/utlidar/imu_livox_mid360", &sensor_msgs_msg_dds__Imu__desc, livox}};
}

std::vector<Row> HgRows(const robot::RobotSpec& spec) {
  std::vector<Row> rows = {
      {"rt/lowstate", &unitree_hg_msg_dds__LowState__desc, 1000},
      {"rt/lf/lowstate", &unitree_hg_msg_dds__LowState__desc, 20},
      {"rt/odommodestate", &unitree_go_msg_dds__SportModeState__desc, 500},
      {"rt/lf/odommodestate", &unitree_go_msg_dds__SportModeState__desc, 20},
      {"rt/lf/bmsstate", &unitree_hg_msg_dds__BmsState__desc, 20},
      {"rt/lf/mainboardstate", &unitree_hg_msg_dds__MainBoardState__desc, 20},
      {"rt/wirelesscontroller", &unitree_go_msg_dds__WirelessController__desc, 500}};
  const bool second = !spec.imu.secondary_site.empty();
  rows.push_back({"rt/secondary_imu", &unitree_hg_msg_dds__IMUState__desc, second ? 1000 : 0});
  rows.push_back({"rt/lf/secondary_imu", &unitree_hg_msg_dds__IMUState__desc, second ? 20 : 0});
  const bool fsm = robot::TellsStateId(spec);
  rows.push_back({"rt/sportmodestate", &unitree_hg_msg_dds__SportModeState__desc, fsm ? 500 : 0});
  rows.push_back({"rt/lf/sportmodestate", &unitree_hg_msg_dds__SportModeState__desc, fsm ? 20 : 0});
  const int acts = spec.arm_action_state ? 10 : 0;
  rows.push_back({"rt/arm/action/state", &std_msgs_msg_dds__String__desc, acts});
  const int livox = spec.name.starts_with("g1") || spec.name == "h1_2" ? 1 : 0;
  rows.push_back({"rt/utlidar/cloud_livox_mid360", &sensor_msgs_msg_dds__PointCloud2__desc, livox});
  rows.push_back({"rt/utlidar/imu_livox_mid360", &sensor_msgs_msg_dds__Imu__desc, livox});
  for (const robot::HandSpec& hand : spec.hands) {
    const dds_topic_descriptor* type = &unitree_hg_msg_dds__HandState__desc;
    rows.push_back({"rt/" + hand.topic + "/state", type, static_cast<int>(hand.hz)});
    rows.push_back({"rt/lf/" + hand.topic + "/state", type, 20});
  }
  return rows;
}

// The topics that are written; those of commands are read.
std::set<std::string> Told(bus::EndpointWatch* watch) {
  std::set<std::string> told;
  for (const bus::TopicOnBus& topic : watch->Poll()) {
    const bool heard = std::ranges::count(robot::kCommandTopicNames, topic.topic) != 0;
    if (!heard && !topic.topic.ends_with("/cmd")) told.insert(topic.topic);
  }
  return told;
}

std::set<std::string> Topics(const std::vector<Row>& rows) {
  std::set<std::string> topics;
  for (const Row& row : rows) {
    if (row.hz > 0) topics.insert(row.topic);
  }
  return topics;
}

TEST(PublicationsTest, HaveTheirRatesOnEveryRobotAndThereAreNoOthers) {
  const std::filesystem::path root(UNDERSTUDY_SOURCE_DIR);
  for (const std::string& name : config::RobotNames(root)) {
    SCOPED_TRACE(name);
    const config::Config config = config::LoadConfig({.robot = name}, root);
    const robot::RobotSpec& spec = config.robots[0].spec;
    const bus::Participant participant("lo", test::NewDomain());
    bus::EndpointWatch watch(participant);
    Port port(participant, spec, config.physics.timestep);
    const std::vector<Row> rows =
        spec.family == robot::WireFamily::kGo ? GoRows(spec) : HgRows(spec);
    EXPECT_EQ(Told(&watch), Topics(rows));
    std::vector<std::string> without_a_bus;
    for (const StateMessage& message : StateMessages(spec)) {
      for (const RobotTopic& topic : message.topics) without_a_bus.push_back(topic.name);
    }
    for (const LidarMessage& message : LidarMessages(spec)) {
      without_a_bus.push_back(message.topic.name);
    }
    EXPECT_EQ(port.topics(), without_a_bus);
    std::deque<bus::CdrReader> readers;
    for (const Row& row : rows) readers.emplace_back(participant, row.topic, *row.type);

    robot::RobotState state = StateOf(spec);
    state.remote.there = true;
    state.motion.emplace().estimates = true;
    state.leg_odometry.emplace();
    state.motors[0].overheated = true;
    const auto steps = std::llround(1 / config.physics.timestep);
    for (std::int64_t step = 0; step < steps; ++step) {
      if (port.Due(step)) port.Publish(state, step);
    }
    for (const LidarMessage& message : LidarMessages(spec)) port.PublishLidar(message.content, {});
    std::vector<int> heard(rows.size());
    test::Eventually([&] {
      bool all = true;
      for (std::size_t i = 0; i < rows.size(); ++i) {
        readers[i].Take([&](const bus::CdrSample&) { ++heard[i]; });
        all = all && heard[i] >= rows[i].hz;
      }
      return all;
    });
    for (std::size_t i = 0; i < rows.size(); ++i) EXPECT_EQ(heard[i], rows[i].hz) << rows[i].topic;
    EXPECT_EQ(port.counts().lowstates, static_cast<std::uint64_t>(rows[0].hz));
    EXPECT_EQ(port.counts().write_failures, 0U);
  }
}

// The legs make it: a robot that carries another lidar than the vendor's tells it as well.
TEST(PublicationsTest, HaveTheOdometryOfAQuadrupedWithAnyLidar) {
  const auto tells_odometry = [](const char* make) {
    robot::RobotSpec spec =
        config::LoadConfig({.robot = "go2"}, UNDERSTUDY_SOURCE_DIR).robots[0].spec;
    spec.lidar.make = make;
    return std::ranges::count(StateMessages(spec), Content::kOdometry, &StateMessage::content) == 1;
  };
  EXPECT_TRUE(tells_odometry("L1"));
  EXPECT_TRUE(tells_odometry("Mid-360"));
  EXPECT_FALSE(tells_odometry("none"));
}

TEST(PublicationsTest, KeepToStepsOfOtherLengths) {
  const bus::Participant participant("lo", test::NewDomain());
  robot::RobotSpec spec = GoRobot();
  spec.rates = {.lowstate_hz = 500, .motion_hz = 250, .lf_hz = 20};
  for (const double timestep : {0.0005, 0.002, 0.0001}) {
    const Port port(participant, spec, timestep);
    const auto per_state = std::llround(0.002 / timestep);
    for (std::int64_t step = 0; step < 10 * per_state; ++step) {
      EXPECT_EQ(port.Due(step), step % per_state == 0) << timestep << " s, step " << step;
    }
  }
}

}  // namespace
}  // namespace understudy::wire
