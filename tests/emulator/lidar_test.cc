// Tests in whole ticks what a Go2's lidar sees, and when it is sent.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "assembly/simulation.h"
#include "config/load.h"
#include "mjcf/eigen_views.h"
#include "perception/clearance.h"
#include "robot/rotations.h"
#include "tests/emulator/state_bytes.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::emulator {
namespace {

using wire::Content;
constexpr int kCloudSteps = 67;  // a little more than a cloud takes

class LidarTest : public test::MujocoTest {
 protected:
  // A Go2 that stands.
  LidarTest() { Start({}); }

  // On flat ground, with a geom in MJCF.
  void StartBefore(const std::string& geom) {
    const test::TemporaryFolder folder;
    const std::string scene =
        "<mujoco><worldbody><geom type=\"plane\" size=\"0 0 1\"/>" + geom + "</worldbody></mujoco>";
    Start({"scene=" + folder.Write("scene.xml", scene).string()});
  }

  void Start(std::vector<std::string> sets, const std::string& robot = "go2") {
    world_.reset();
    port_ = std::make_unique<test::FakePort>();
    services_ = std::make_unique<test::FakeServices>();
    sets.emplace_back("start.pose=standing");
    world_ = std::make_unique<assembly::Simulation>(
        config::LoadConfig({.robot = robot, .sets = sets}, UNDERSTUDY_SOURCE_DIR),
        [this](std::size_t) {
          return emulator::Ports{port_.get(), services_.get()};
        });
  }
  void Switch(std::string_view program, bool on) {
    services_->Call([=](authority::MotorOwner* owner) { owner->Switch(program, on); });
  }
  std::vector<robot::PointCloud> Clouds(Content content) const {
    std::vector<robot::PointCloud> clouds;
    for (const robot::LidarReading& reading : Readings(content)) clouds.push_back(reading.cloud);
    return clouds;
  }
  std::vector<robot::LidarReading> Readings(Content content) const {
    std::vector<robot::LidarReading> readings;
    for (const auto& sent : port_->sights()) {
      if (sent.content == content) readings.push_back(sent.reading);
    }
    return readings;
  }
  // What comes within a second.
  std::vector<robot::LidarReading> Second(Content content) {
    port_->ReadLidar({content});
    const std::size_t before = Readings(content).size();
    world_->Step(1000);
    const auto all = Readings(content);
    return {all.begin() + static_cast<std::ptrdiff_t>(before), all.end()};
  }
  void Release() {
    services_->Call([](authority::MotorOwner* owner) { owner->Release(); });
  }
  std::size_t CloudsIn(int steps, Content content = Content::kCloud) {
    const std::size_t before = Clouds(content).size();
    world_->Step(steps);
    return Clouds(content).size() - before;
  }

  std::unique_ptr<test::FakePort> port_;
  std::unique_ptr<test::FakeServices> services_;
  std::unique_ptr<assembly::Simulation> world_;
};

TEST_F(LidarTest, SendsWhatIsReadAndNothingElse) {
  EXPECT_EQ(CloudsIn(200), 0U);
  port_->ReadLidar({Content::kCloud});
  EXPECT_EQ(CloudsIn(1000), 14U) << "of the cloud under way it saw only the end";
  EXPECT_EQ(Clouds(Content::kCloudBase).size(), 0U);
  port_->ReadLidar({Content::kCloud, Content::kCloudBase});
  EXPECT_EQ(CloudsIn(200, Content::kCloudBase), 3U);
  port_->ReadLidar({});
  EXPECT_EQ(CloudsIn(200), 0U);
}

TEST_F(LidarTest, StampsACloudWithTheTimeOfItsFirstSample) {
  port_->ReadLidar({Content::kCloud});
  world_->Step(1001);
  const auto clouds = Clouds(Content::kCloud);
  ASSERT_EQ(clouds.size(), 15U);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].stamp_ns, static_cast<std::int64_t>(i) * 200'000'000 / 3);
  }
}

TEST_F(LidarTest, SeesTheGroundAndItsOwnLegs) {
  port_->ReadLidar({Content::kCloud});
  world_->Step(1001);
  const robot::LidarSpec& lidar = world_->config().robots[0].spec.lidar;
  const Eigen::Matrix3d R_BL = robot::FromRollPitchYaw(lidar.rpy);
  const double height = world_->world().physics().robot().base().p_WB.z();
  double ground = 0, legs = 0, all = 0;
  for (const robot::PointCloud& cloud : Clouds(Content::kCloud)) {
    for (const robot::LidarPoint& point : cloud.points) {
      const Eigen::Vector3d at = R_BL * Eigen::Vector3d(point.x, point.y, point.z) + lidar.pos;
      ++all;
      if (at.head<2>().norm() < 4 && std::abs(at.z() + height) < 0.1) ++ground;
      if (at.z() > 0.1 - height && std::abs(at.x()) < 0.5 && std::abs(at.y()) < 0.3) ++legs;
    }
  }
  EXPECT_GT(all, 15 * 1000);
  EXPECT_GT(ground / all, 0.6);
  EXPECT_GT(legs / all, 0.005);
  EXPECT_LT(legs / all, 0.4) << "its housing is not in the way";
}

TEST_F(LidarTest, SendsCloudBaseOnlyWhileTheMotionServiceIsOn) {
  port_->ReadLidar({Content::kCloud, Content::kCloudBase});
  EXPECT_EQ(CloudsIn(3 * kCloudSteps, Content::kCloudBase), 3U);
  Release();
  EXPECT_EQ(CloudsIn(3 * kCloudSteps, Content::kCloudBase), 0U);
  EXPECT_EQ(CloudsIn(3 * kCloudSteps, Content::kCloud), 3U);
}

TEST_F(LidarTest, SendsEachContentAtItsRateAndStopsWhatNeedsTheMotionService) {
  const std::map<Content, std::pair<std::size_t, bool>> rates = {
      {Content::kCloudDeskewed, {14, true}}, {Content::kImuOfLidar, {250, false}},
      {Content::kStateOfLidar, {5, false}},  {Content::kClearance, {14, true}},
      {Content::kHeightMap, {11, true}},     {Content::kVoxelMap, {7, true}},
      {Content::kMapState, {11, true}}};
  for (const auto& [content, rate] : rates) {
    EXPECT_NEAR(static_cast<double>(Second(content).size()), static_cast<double>(rate.first), 1)
        << static_cast<int>(content);
  }
  Release();
  world_->Step(10);
  for (const auto& [content, rate] : rates) {
    EXPECT_EQ(Second(content).empty(), rate.second) << static_cast<int>(content);
  }
}

TEST_F(LidarTest, DeskewsIntoTheFrameOfItsOdometry) {
  const auto clouds = Second(Content::kCloudDeskewed);
  double ground = 0, all = 0;
  for (const robot::LidarPoint& point : clouds.back().deskewed) {
    ++all;
    if (std::abs(point.z) < 0.06) ++ground;
  }
  EXPECT_GT(ground / all, 0.5);
}

TEST_F(LidarTest, FeelsTheWeightInTheLidarsAxes) {
  const auto readings = Second(Content::kImuOfLidar);
  Eigen::Vector3d f = Eigen::Vector3d::Zero();
  for (const robot::LidarReading& reading : readings) f += reading.imu.f_WI_I;
  f /= static_cast<double>(readings.size());
  EXPECT_NEAR(f.norm(), 9.81, 0.05);
  const robot::LidarSpec& lidar = world_->config().robots[0].spec.lidar;
  const Eigen::Vector3d up = robot::FromRollPitchYaw(lidar.rpy) * f;
  EXPECT_GT(up.z(), 9.7) << "turned into the base it is upright";
  EXPECT_LT(f.z(), -9) << "real ones: (1.71, -1.86, -9.18), (1.98, -2.79, -9.18)";
}

TEST_F(LidarTest, MapsTheGroundAtItsHeight) {
  const auto maps = Second(Content::kHeightMap);
  double seen = 0, off = 0;
  for (const float height : maps.back().map.heights) {
    if (height == robot::HeightMap::kUnseen) continue;
    ++seen;
    off = std::max(off, std::abs(static_cast<double>(height)));
  }
  EXPECT_GT(seen, 1000);
  EXPECT_LT(off, 0.15) << "no leg is in it";
}

TEST_F(LidarTest, FillsTheVoxelsOfTheGroundAndOfABoxWhereTheyAre) {
  StartBefore(R"(<geom type="box" size="0.2 0.3 0.2" pos="1.1 0.4 0.2"/>)");
  const robot::VoxelMap map = Second(Content::kVoxelMap).back().voxels;
  const auto is_full = [&map](double x, double y, double z) {
    const Eigen::Vector3d cell = (Eigen::Vector3d(x, y, z) - map.origin) / robot::VoxelMap::kCell;
    const auto place = [](double at) { return static_cast<std::size_t>(std::lround(at)); };
    const std::size_t row = (place(cell.z()) * 128 + place(cell.y())) * 16;
    return (map.bits.at(row + place(cell.x()) / 8) >> (7 - place(cell.x()) % 8) & 1) != 0;
  };
  const Eigen::Vector3d front = world_->world().physics().robot().base().p_WB;
  int face = 0, ground = 0, air = 0;
  for (double y = 0.15; y < 0.7; y += 0.05) {
    for (double z = 0.1; z < 0.35; z += 0.05) {
      // A voxel either way: odometry began where the base is now.
      for (const double off : {-0.05, 0.0, 0.05}) face += is_full(0.9 - front.x() + off, y, z);
      air += is_full(0.6 - front.x(), y, z);
    }
  }
  for (double y = -0.5; y < 0; y += 0.05) ground += is_full(0.8, y, -0.02);
  EXPECT_GT(face, 20);
  EXPECT_EQ(air, 0);
  EXPECT_GT(ground, 3);
}

TEST_F(LidarTest, MeasuresHowFarAWallIs) {
  StartBefore(R"(<geom type="box" size="0.1 3 1" pos="1.3 0 1"/>)");
  const Eigen::Vector3d clear = Second(Content::kClearance).back().clear;
  EXPECT_NEAR(clear.x(), 1.2 - world_->world().physics().robot().base().p_WB.x(), 0.03);
  EXPECT_EQ(clear.y(), perception::Clearance::kFarthest);
  EXPECT_EQ(clear.z(), perception::Clearance::kFarthest);
}

TEST_F(LidarTest, HasTheFaultsOfALidar) {
  const auto fault = [this](const char* name, nlohmann::json by = nullptr) {
    world_->Request("fault", {{"component", "lidar"}, {"fault", "none"}});
    nlohmann::json request{{"component", "lidar"}, {"fault", name}};
    if (!by.is_null()) request["by"] = by;
    world_->Request("fault", request);
  };
  fault("blind");
  const auto blind = Second(Content::kCloud);
  ASSERT_FALSE(blind.empty());
  EXPECT_TRUE(blind.back().cloud.points.empty());
  EXPECT_TRUE(Second(Content::kStateOfLidar).back().status.blind);
  fault("lost", 0.5);
  EXPECT_LT(Second(Content::kCloud).back().cloud.points.size(), 800U);
  fault("dirty", 0.6);
  EXPECT_LT(Second(Content::kCloud).back().cloud.points.size(), 1000U);
  EXPECT_EQ(Second(Content::kStateOfLidar).back().status.dirt, 0.6);
  fault("noisy", 0.3);
  EXPECT_GT(Second(Content::kClearance).size(), 10U);
  fault("off");
  EXPECT_TRUE(Second(Content::kCloud).empty());
  EXPECT_TRUE(Second(Content::kImuOfLidar).empty());
}

TEST_F(LidarTest, IsAMid360OnTheTorsoOfHumanoids) {
  for (const char* robot : {"g1", "h1", "h1_2"}) {
    SCOPED_TRACE(robot);
    Start({}, robot);
    const auto clouds = Second(Content::kCloud);
    ASSERT_NEAR(static_cast<double>(clouds.size()), 9, 1);
    ASSERT_EQ(clouds.back().cloud.points.size(), 20'000U);
    const robot::LidarSpec& lidar = world_->config().robots[0].spec.lidar;
    const physics::MujocoWorld& physics = world_->world().physics();
    const int torso = physics.robot().Body("torso_link");
    const Eigen::Matrix3d R_WL =
        mjcf::RotationView(physics.data().xmat + 9 * torso) * robot::FromRollPitchYaw(lidar.rpy);
    const Eigen::Vector3d p_WL = mjcf::Vector(physics.data().xpos + 3 * torso) +
                                 mjcf::RotationView(physics.data().xmat + 9 * torso) * lidar.pos;
    double ground = 0;
    for (const robot::LidarPoint& p : clouds.back().cloud.points) {
      if (p.x == 0 && p.y == 0 && p.z == 0) continue;
      if (std::abs((p_WL + R_WL * Eigen::Vector3d(p.x, p.y, p.z)).z()) < 0.1) ++ground;
    }
    EXPECT_GT(ground, 2000);
    const auto imu = Second(Content::kImuOfLidar);
    ASSERT_NEAR(static_cast<double>(imu.size()), 200, 1);
    EXPECT_NEAR(imu.back().imu.f_WI_I.norm(), 9.81, 1);
  }
}

TEST_F(LidarTest, SendsNothingWhileItsProgramIsOff) {
  port_->ReadLidar({Content::kCloud});
  Switch("unitree_lidar", false);
  EXPECT_EQ(CloudsIn(300), 0U);
  Switch("unitree_lidar", true);
  EXPECT_EQ(CloudsIn(3 * kCloudSteps), 2U);
}

TEST_F(LidarTest, SendsNothingWhileTheRobotIsOff) {
  port_->ReadLidar({Content::kCloud});
  world_->Request("power", {{"on", false}});
  EXPECT_EQ(CloudsIn(300), 0U);
}

TEST_F(LidarTest, ChangesNoBitOfAState) {
  world_->Step(500);
  const auto without = port_->samples();
  Start({});
  port_->ReadLidar({Content::kCloud, Content::kCloudBase});
  world_->Step(500);
  ASSERT_EQ(port_->samples().size(), without.size());
  for (std::size_t i = 0; i < without.size(); ++i) {
    ASSERT_EQ(Bytes(port_->samples()[i].state), Bytes(without[i].state)) << i;
  }
}

TEST_F(LidarTest, IsNotThereWithMakeNone) {
  Start({"robot.lidar.make=none"});
  port_->ReadLidar({Content::kCloud});
  EXPECT_EQ(CloudsIn(300), 0U);
}

}  // namespace
}  // namespace understudy::emulator
