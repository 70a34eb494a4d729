#include "perception/lidar.h"

#include <cmath>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "physics/world_model.h"
#include "tests/support/allocations.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::perception {
namespace {

constexpr double kDt = 0.001, kBeamStart = 0.0445;

// A lidar that looks down from a metre over a plane, in a housing.
class LidarTest : public test::MujocoTest {
 protected:
  LidarTest() {
    const test::TemporaryFolder folder;
    model_ = physics::LoadModelFile(folder.Write("scene.xml", R"(<mujoco><worldbody>
        <geom type="plane" size="0 0 1"/>
        <body name="base" pos="0 0 1"><freejoint/>
          <geom type="sphere" size="0.05" pos="0 0 -0.0445"/></body></worldbody></mujoco>)"));
    data_.reset(mj_makeData(model_.get()));
    mj_kinematics(model_.get(), data_.get());
    spec_.make = "L1";
    spec_.rpy = {std::numbers::pi, 0, 0};
    spec_.range = {0.05, 30};
    errors_ = {.quantise = false, .noise = false};
  }

  void Start() {
    scene_.emplace(*model_, *data_);
    lidar_ = std::make_unique<Lidar>(spec_, errors_, 1, *model_, *data_, *scene_, kDt);
  }
  // The clouds of the steps from `from` on; the base moves by `speed` [m/s] along x and z.
  std::vector<robot::PointCloud> Clouds(std::int64_t from, std::int64_t to, double vx = 0,
                                        double vz = 0) {
    std::vector<robot::PointCloud> clouds;
    for (std::int64_t step = from; step < to; ++step) {
      data_->qpos[0] = vx * kDt * static_cast<double>(step);
      data_->qpos[2] = 1 + vz * kDt * static_cast<double>(step);
      mj_kinematics(model_.get(), data_.get());
      scene_->Follow(step, *data_);
      if (lidar_->Sense(step, *data_, *scene_, faults_)) clouds.push_back(lidar_->reading().cloud);
    }
    return clouds;
  }
  std::vector<robot::PointCloud> CloudsOfASecond() {
    Start();
    return Clouds(0, 1001);
  }

  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  robot::LidarSpec spec_;
  sensors::SensorConfig errors_;
  robot::LidarEffects faults_;
  std::optional<RayCaster> scene_;
  std::unique_ptr<Lidar> lidar_;
};

using Points = std::vector<std::array<float, 5>>;
Points PointsOf(const robot::PointCloud& cloud) {
  Points points;
  for (const robot::LidarPoint& p : cloud.points) {
    points.push_back({p.x, p.y, p.z, p.intensity, p.time});
  }
  return points;
}

TEST_F(LidarTest, HasFifteenCloudsASecondOfAllThatIsWithinItsRange) {
  const auto clouds = CloudsOfASecond();
  ASSERT_EQ(clouds.size(), 15U);
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(clouds[i].stamp_ns, static_cast<std::int64_t>(i) * 200'000'000 / 3);
    // Of 120 beams of a scan three are so flat that they meet the plane beyond 30 m.
    EXPECT_EQ(clouds[i].points.size(), 12U * 117U);
  }
}

TEST_F(LidarTest, SeesThePlaneThroughItsHousing) {
  for (const robot::PointCloud& cloud : CloudsOfASecond()) {
    for (const robot::LidarPoint& point : cloud.points) {
      ASSERT_NEAR(point.z, 1, 1e-5);
      ASSERT_LE(std::hypot(point.x, point.y), 30);
    }
  }
}

TEST_F(LidarTest, TakesItsSamplesOnTheGridOfTheUnitHalfOfTheTime) {
  for (const robot::PointCloud& cloud : CloudsOfASecond()) {
    for (const robot::LidarPoint& point : cloud.points) {
      const double slot = static_cast<double>(point.time) * 43200;
      ASSERT_NEAR(slot, std::round(slot), 0.01);
      ASSERT_LT(std::llround(slot) % 240, 120);
    }
  }
}

TEST_F(LidarTest, SeesFromWhereItIsMounted) {
  spec_.pos = {0, 0, 0.3};
  for (const robot::PointCloud& cloud : CloudsOfASecond()) {
    for (const robot::LidarPoint& point : cloud.points) {
      ASSERT_TRUE(std::abs(point.z - 1.3) < 1e-5 || point.z < 0.4)
          << "the plane, or the geom below";
    }
  }
}

TEST_F(LidarTest, LooksElsewhereInEachCloud) {
  const auto clouds = CloudsOfASecond();
  EXPECT_NE(PointsOf(clouds[0]), PointsOf(clouds[1]));
  EXPECT_NE(PointsOf(clouds[0]), PointsOf(clouds[14]));
}

TEST_F(LidarTest, CastsEachSampleFromThePosesOfItsInstant) {
  Start();
  const auto clouds = Clouds(0, 100, 0, 1);
  ASSERT_EQ(clouds.size(), 1U);
  for (const robot::LidarPoint& point : clouds[0].points) {
    ASSERT_NEAR(point.z, 1 + point.time, 1.001e-3) << "it rises by 1 m/s";
  }
}

TEST_F(LidarTest, BeginsWithAWholeCloudThatIsTheSameWheneverItBegins) {
  errors_ = {.quantise = true, .noise = true, .seed = 3};
  spec_.noise = 0.02;
  spec_.dropout = 0.1;
  Start();
  const auto early = Clouds(0, 400);
  lidar_->Rest();
  const auto late = Clouds(211, 400);
  ASSERT_EQ(early.size(), 5U);
  ASSERT_EQ(late.size(), 1U);
  EXPECT_EQ(late[0].stamp_ns, early[4].stamp_ns);
  EXPECT_EQ(PointsOf(late[0]), PointsOf(early[4]));
}

TEST_F(LidarTest, HasTheErrorsOfItsSeed) {
  errors_ = {.quantise = true, .noise = true, .seed = 3};
  spec_.noise = 0.02;
  spec_.dropout = 0.1;
  const auto clouds = CloudsOfASecond();
  double sum = 0, squares = 0, count = 0;
  for (const robot::PointCloud& cloud : clouds) {
    for (const robot::LidarPoint& point : cloud.points) {
      const Eigen::Vector3d from_start(point.x, point.y, point.z - kBeamStart);
      const double range = from_start.norm();
      ASSERT_NEAR(range * 1000, std::round(range * 1000), 0.02) << "whole millimetres";
      const double truth = (1 - kBeamStart) * range / from_start.z();
      sum += range - truth;
      squares += (range - truth) * (range - truth);
      ++count;
    }
  }
  EXPECT_NEAR(count, 0.9 * 15 * 12 * 117, 250) << "a tenth is lost";
  EXPECT_NEAR(sum / count, 0, 0.001);
  EXPECT_NEAR(std::sqrt(squares / count), 0.02, 0.001);
  const auto again = CloudsOfASecond();
  errors_.seed = 4;
  const auto others = CloudsOfASecond();
  for (std::size_t i = 0; i < clouds.size(); ++i) {
    EXPECT_EQ(PointsOf(clouds[i]), PointsOf(again[i]));
    EXPECT_NE(PointsOf(clouds[i]), PointsOf(others[i]));
  }
}

TEST_F(LidarTest, HasTheRateAndTheNumberOfPointsOfItsMake) {
  spec_.make = "L2";
  const auto clouds = CloudsOfASecond();
  ASSERT_EQ(clouds.size(), 15U) << "15.43 a second";
  EXPECT_EQ(clouds[1].stamp_ns, 64'814'814);
  for (const robot::PointCloud& cloud : clouds) {
    EXPECT_GT(cloud.points.size(), 4000U);
    EXPECT_LE(cloud.points.size(), 4200U);
    EXPECT_LE(cloud.points.back().time, 0.0625F);
  }
}

TEST_F(LidarTest, KeepsAPointAtZeroForWhatAMid360DoesNotSee) {
  spec_.make = "Mid-360";
  spec_.range = {0.1, 40};
  const auto clouds = CloudsOfASecond();
  ASSERT_EQ(clouds.size(), 10U);
  for (const robot::PointCloud& cloud : clouds) {
    ASSERT_EQ(cloud.points.size(), 20'000U);
    std::size_t echoes = 0;
    for (const robot::LidarPoint& point : cloud.points) {
      if (point.x == 0 && point.y == 0 && point.z == 0) continue;
      ++echoes;
      ASSERT_NEAR(point.z, 1, 1e-5) << "it hangs upside down";
    }
    EXPECT_GT(echoes, 14'000U);
    EXPECT_LT(echoes, 20'000U) << "some look over the horizon";
  }
}

TEST_F(LidarTest, DeskewsACloudByWhereTheRobotTakesItselfToBe) {
  Start();
  robot::LegOdometry base;
  for (std::int64_t step = 0; step < 100; ++step) {
    const double x = 1e-3 * static_cast<double>(step);
    data_->qpos[2] = 1 + x;
    mj_kinematics(model_.get(), data_.get());
    scene_->Follow(step, *data_);
    base.p_OB = {0, 0, 1 + x};
    if (!lidar_->Sense(step, *data_, *scene_, {}, &base)) continue;
    const robot::LidarReading& reading = lidar_->reading();
    ASSERT_EQ(reading.deskewed.size(), reading.cloud.points.size());
    for (const robot::LidarPoint& point : reading.deskewed) ASSERT_NEAR(point.z, 0, 1e-5);
    EXPECT_GT(reading.cloud.points.back().z, 1.05) << "the cloud itself is distorted";
    return;
  }
  FAIL() << "no cloud";
}

TEST_F(LidarTest, LosesWhatItsFaultsTake) {
  const auto points = [this](const robot::LidarEffects& faults) {
    faults_ = faults;
    double count = 0;
    for (const robot::PointCloud& cloud : CloudsOfASecond()) {
      count += static_cast<double>(cloud.points.size());
    }
    return count / (15 * 12 * 117);
  };
  EXPECT_EQ(points({}), 1);
  EXPECT_EQ(points({.blind = true}), 0);
  EXPECT_NEAR(points({.lost = 0.25}), 0.75, 0.01);
  EXPECT_NEAR(points({.dirt = 0.25}), 0.75, 0.12) << "in patches";
}

TEST_F(LidarTest, LooksThroughTheSameCleanPartsOfADirtyWindow) {
  const auto seen = [this] {
    std::set<int> sectors;
    for (const robot::PointCloud& cloud : CloudsOfASecond()) {
      for (const robot::LidarPoint& p : cloud.points) {
        if (std::hypot(p.x, p.y) > 10) sectors.insert(static_cast<int>(18 * std::atan2(p.y, p.x)));
      }
    }
    return sectors;
  };
  const std::size_t clean = seen().size();
  faults_.dirt = 0.5;
  const auto dirty = seen();
  EXPECT_LT(dirty.size(), clean);
  EXPECT_EQ(seen(), dirty);
}

TEST_F(LidarTest, SpreadsItsRangesWithAFault) {
  faults_.noise = 0.05;
  double squares = 0, count = 0;
  for (const robot::PointCloud& cloud : CloudsOfASecond()) {
    for (const robot::LidarPoint& point : cloud.points) {
      const Eigen::Vector3d from_start(point.x, point.y, point.z - kBeamStart);
      const double truth = (1 - kBeamStart) * from_start.norm() / from_start.z();
      squares += (from_start.norm() - truth) * (from_start.norm() - truth);
      ++count;
    }
  }
  EXPECT_NEAR(std::sqrt(squares / count), 0.05, 0.002);
}

TEST_F(LidarTest, FeelsInItsOwnAxes) {
  Start();
  data_->qvel[5] = 2;
  mj_forward(model_.get(), data_.get());
  mj_rnePostConstraint(model_.get(), data_.get());
  lidar_->Feel(7, *data_, {});
  const robot::ImuReading& imu = lidar_->reading().imu;
  EXPECT_TRUE(imu.w_WI_I.isApprox(Eigen::Vector3d(0, 0, -2), 1e-9)) << "it hangs upside down";
  EXPECT_LT(imu.f_WI_I.norm(), 1e-9) << "it falls";
  spec_.pos = {0.5, 0, 0};
  Start();
  lidar_->Feel(7, *data_, {});
  EXPECT_TRUE(lidar_->reading().imu.f_WI_I.isApprox(Eigen::Vector3d(-2, 0, 0), 1e-9))
      << "half a metre from the axis";
}

TEST_F(LidarTest, AllocatesNothing) {
  Start();
  const std::uint64_t before = test::Allocations();
  int complete = 0;
  const robot::LegOdometry base;
  for (std::int64_t step = 0; step < 300; ++step) {
    scene_->Follow(step, *data_);
    complete += lidar_->Sense(step, *data_, *scene_, {.dirt = 0.1}, &base) ? 1 : 0;
  }
  EXPECT_EQ(test::Allocations(), before);
  EXPECT_EQ(complete, 4);
}

}  // namespace
}  // namespace understudy::perception
