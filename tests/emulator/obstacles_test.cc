// Tests in whole ticks that a Go2 which avoids obstacles stops before what its lidar sees.
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "assembly/simulation.h"
#include "config/load.h"
#include "tests/emulator/state_bytes.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::emulator {
namespace {

namespace goal = authority::goal;

constexpr double kNose = 0.335;  // m ahead of the base's origin
constexpr double kWall = 2.0;    // m, where the face of the wall is

class ObstaclesTest : public test::MujocoTest {
 protected:
  // A Go2 that stands before things; `switched` as SwitchSet has it.
  void Start(const std::string& things, bool switched = true, std::vector<std::string> sets = {}) {
    world_.reset();
    services_ = std::make_unique<test::FakeServices>();
    port_ = std::make_unique<test::FakePort>();
    sets.push_back("scene=" + folder_
                                  .Write("things.xml",
                                         "<mujoco><worldbody><geom type='plane' "
                                         "size='0 0 1'/>" +
                                             things + "</worldbody></mujoco>")
                                  .string());
    sets.emplace_back("start.pose=standing");
    world_ = std::make_unique<assembly::Simulation>(
        config::LoadConfig({.robot = "go2", .sets = sets}, UNDERSTUDY_SOURCE_DIR),
        [this](std::size_t) {
          return emulator::Ports{port_.get(), services_.get()};
        });
    services_->Call(
        [switched](authority::MotorOwner* owner) { owner->onboard().avoids = switched; });
    world_->Step(500);
  }
  void StartBeforeAWall(bool switched = true, std::vector<std::string> sets = {}) {
    Start(Wall(kWall), switched, std::move(sets));
  }
  static std::string Wall(double x) {
    return "<geom type='box' size='0.1 4 0.5' pos='" + std::to_string(x + 0.1) + " 0 0.5'/>";
  }
  // Asks for a velocity again and again.
  void Move(const Eigen::Vector3d& v, double seconds, bool avoids = true) {
    for (double t = 0; t < seconds; t += 0.1) {
      services_->Call([=](authority::MotorOwner* owner) {
        owner->Ask(
            goal::Move{.vx = v.x(), .vy = v.y(), .yaw_rate = v.z(), .hold = 1, .avoids = avoids});
      });
      world_->Step(100);
      nearest_ = std::min(nearest_, kWall - kNose - Place().x());
    }
  }
  Eigen::Vector3d Place() const { return world_->world().physics().robot().base().p_WB; }
  void Blind() { world_->Request("fault", {{"component", "lidar"}, {"fault", "blind"}}); }

  test::TemporaryFolder folder_;
  std::unique_ptr<test::FakePort> port_;
  std::unique_ptr<test::FakeServices> services_;
  std::unique_ptr<assembly::Simulation> world_;
  double nearest_ = kWall;  // m that its nose was from the wall
};

TEST_F(ObstaclesTest, StopsBeforeAWallAtEachSpeed) {
  for (const double speed : {0.3, 0.5, 1.0}) {
    SCOPED_TRACE(speed);
    nearest_ = kWall;
    StartBeforeAWall();
    Move({speed, 0, 0}, 2 + 3 / speed);
    EXPECT_GT(nearest_, 0.2);
    EXPECT_LT(nearest_, 0.7) << "it came up to the wall";
    const double x = Place().x();
    Move({speed, 0, 0}, 1);
    EXPECT_NEAR(Place().x(), x, 0.05);
  }
}

TEST_F(ObstaclesTest, WalksIntoAWallThatItIsNotAskedToAvoid) {
  StartBeforeAWall();
  Move({0.5, 0, 0}, 5, /*avoids=*/false);
  EXPECT_LT(nearest_, 0.1);
}

TEST_F(ObstaclesTest, WalksIntoAWallThatABlindLidarDoesNotSee) {
  StartBeforeAWall();
  Blind();
  Move({0.5, 0, 0}, 5);
  EXPECT_LT(nearest_, 0.1);
}

TEST_F(ObstaclesTest, StopsTheSticksWhileTheSwitchIsOn) {
  for (const bool switched : {true, false}) {
    nearest_ = kWall;
    StartBeforeAWall(switched);
    world_->Request("remote.sticks", {{"ly", 0.5}, {"for", 8}});
    for (int i = 0; i < 60; ++i) {
      world_->Step(100);
      nearest_ = std::min(nearest_, kWall - kNose - Place().x());
    }
    if (switched) {
      EXPECT_GT(nearest_, 0.2);
      EXPECT_LT(nearest_, 0.7);
    } else {
      EXPECT_LT(nearest_, 0.1);
    }
  }
}

TEST_F(ObstaclesTest, StopsOnItsWayToAPlace) {
  StartBeforeAWall();
  services_->Call([](authority::MotorOwner* owner) {
    owner->Ask(goal::GoTo{.x = 2.5, .from_here = true, .avoids = true});
  });
  for (int i = 0; i < 100; ++i) {
    world_->Step(100);
    nearest_ = std::min(nearest_, kWall - kNose - Place().x());
  }
  EXPECT_GT(nearest_, 0.2);
  EXPECT_LT(nearest_, 0.7);
}

TEST_F(ObstaclesTest, GoesRoundABox) {
  Start("<geom type='box' size='0.15 0.15 0.2' pos='1.6 0 0.2'/>");
  Move({0.6, 0, 0}, 10);
  EXPECT_GT(Place().x(), 2.2) << "it is past it";
  EXPECT_GT(std::abs(Place().y()), 0.2);
}

TEST_F(ObstaclesTest, StopsBeforeAnotherRobot) {
  // Its trunk and a leg.
  Start(
      "<geom type='box' size='0.1 0.3 0.06' pos='1.6 0 0.32'/>"
      "<geom type='box' size='0.02 0.02 0.13' pos='1.6 0.2 0.13'/>"
      "<geom type='box' size='0.1 1 0.06' pos='1.6 1.3 0.32'/>"
      "<geom type='box' size='0.1 1 0.06' pos='1.6 -1.3 0.32'/>");
  Move({0.5, 0, 0}, 6);
  EXPECT_LT(Place().x(), 1.5 - kNose - 0.2);
  EXPECT_GT(Place().x(), 0.5);
}

TEST_F(ObstaclesTest, WalksOnOverFlatGroundAndASlope) {
  Start("");
  Move({0.8, 0, 0}, 4);
  EXPECT_GT(Place().x(), 1.8) << "it sees nothing where nothing is";
  Start("<geom type='box' size='3 2 0.1' pos='3.4 0 0.17' euler='0 -0.14 0'/>");
  Move({0.5, 0, 0}, 6);
  EXPECT_GT(Place().x(), 2);
  EXPECT_GT(Place().z(), 0.4) << "it is on the slope";
}

TEST_F(ObstaclesTest, TellsHowFarThingsAreBeforeFirmware116AlsoWhereNothingIsAsked) {
  const auto ranges = [this] { return world_->world().robot(0).sampled().obstacle_ranges; };
  Start(Wall(2.4), true, {"robot.firmware=1.0.25"});
  EXPECT_EQ(ranges()[0], robot::kNoObstacle) << "that is further";
  Start(Wall(1.2), true, {"robot.firmware=1.0.25"});
  EXPECT_NEAR(ranges()[0], 1.2 - Place().x(), 0.06);
  EXPECT_EQ(ranges()[2], robot::kNoObstacle);
  Start(Wall(1.2), false, {"robot.firmware=1.0.25"});
  EXPECT_EQ(ranges()[0], robot::kNoObstacle) << "nothing is looked for";
  Start(Wall(1.2));
  EXPECT_EQ(ranges()[0], robot::kNoObstacle) << "newer ones do not have it";
}

TEST_F(ObstaclesTest, IsTheSameBitByBitInEachRun) {
  const auto run = [this] {
    StartBeforeAWall();
    Move({0.6, 0.1, 0.1}, 4);
    return Place();
  };
  const Eigen::Vector3d first = run();
  EXPECT_EQ(run(), first);
}

}  // namespace
}  // namespace understudy::emulator
