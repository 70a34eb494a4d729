// How quadrupeds walk and drive.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/motion/quadruped/rig.h"
#include "tests/motion/quadruped/trial.h"
#include "tests/support/allocations.h"
#include "tests/support/robots.h"
#include "tests/support/temporary_folder.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr int kLying = 1004, kBalance = 1013, kWalking = 100;

std::vector<std::string> Legged() {
  return test::RobotsThat(
      [](const robot::RobotSpec& spec) { return spec.kind == robot::RobotKind::kQuadruped; });
}

// A plane whose height grows by these slopes along x and y.
std::filesystem::path SlopeIn(test::TemporaryFolder& folder, double x, double y) {
  return folder.Write("slope.xml",
                      "<mujoco><worldbody><geom type='plane' size='0 0 1' condim='3' "
                      "friction='0.8 0.005 0.0001' zaxis='" +
                          std::to_string(-x) + " " + std::to_string(-y) +
                          " 1'/></worldbody></mujoco>");
}

// Legged and wheeled.
class MoveTest : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override { rig_.BalanceStand(); }
  const robot::WalkSpec& walk() const { return rig_.spec().motion.quadruped.walk; }
  double mass() { return rig_.world().robot().weight() / 9.81; }

  // From rest, two seconds later: within a tenth of what is wanted, or 0.03 of m/s or rad/s.
  void ExpectFollows(const Vector3d& wish) {
    rig_.Ask(goal::StopMove{});
    ASSERT_TRUE(rig_.ComesToRest(6));
    rig_.Walk(wish, 2);
    const Vector3d speed = rig_.Speed(wish, 3);
    for (int i = 0; i < 3; ++i) {
      const double wanted = walk().gain[i] * wish[i];
      EXPECT_NEAR(speed[i], wanted, std::max(0.03, 0.1 * std::abs(wanted)))
          << "axis " << i << " of " << wish.transpose();
    }
    EXPECT_LT(rig_.tilt(), 0.2);
  }

  WalkingRig rig_{GetParam()};
};

TEST_P(MoveTest, FollowsWhatMoveAsksFor) {
  for (const Vector3d& wish : {Vector3d(0.3, 0, 0), Vector3d(1, 0, 0), Vector3d(-0.5, 0, 0),
                               Vector3d(0, 0.3, 0), Vector3d(0, -0.3, 0), Vector3d(0, 0, 0.8),
                               Vector3d(0, 0, -0.8), Vector3d(0.5, 0.15, 0.5)}) {
    ExpectFollows(wish);
  }
}

TEST_P(MoveTest, IsAsFastAsItsFiguresSay) {
  for (int axis = 0; axis < 3; ++axis) {
    ExpectFollows(walk().most_speed[axis] * Vector3d::Unit(axis));
    ExpectFollows(walk().least_speed[axis] * Vector3d::Unit(axis));
  }
}

TEST_P(MoveTest, StartsAndStopsWithoutATwitch) {
  rig_.Run(1);
  const double stand = rig_.height();
  double low = stand, high = stand, tilt = 0;
  rig_.watch = [&] {
    low = std::min(low, rig_.height());
    high = std::max(high, rig_.height());
    tilt = std::max(tilt, rig_.tilt());
  };
  rig_.Walk({0.4, 0, 0}, 3);
  EXPECT_EQ(rig_.Ask(goal::StopMove{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.ComesToRest(4));
  const Vector3d before = rig_.world().robot().base().p_WB;
  rig_.Run(2);
  EXPECT_LT((rig_.world().robot().base().p_WB - before).norm(), 0.03);
  EXPECT_LT(rig_.fastest(), 0.1) << "an idle robot stands still";
  EXPECT_LT(high - low, 0.04 * stand);
  EXPECT_LT(tilt, 0.08);
}

TEST_P(MoveTest, TakesAPushFromAnySide) {
  const double force = PushOf(rig_.spec()) * mass() / 0.1;
  for (int side = 0; side < 8; ++side) {
    rig_.Walk({0.4, 0, 0}, 1.5 + 0.06 * side);
    const double way = side * M_PI / 4 + rig_.rpy().z();
    rig_.Push(force * Vector3d(std::cos(way), std::sin(way), 0), 0.1);
    rig_.Walk({0.4, 0, 0}, 2);
    ASSERT_EQ(rig_.state().id, kWalking) << PushOf(rig_.spec()) << " N·s/kg from side " << side;
  }
}

TEST_P(MoveTest, GoesUpDownAndAcrossFifteenDegrees) {
  const double steep = std::tan(15 * M_PI / 180), wanted = 0.5 * walk().gain.x();
  test::TemporaryFolder folder;
  for (const auto& [x, y] :
       {std::pair(steep, 0.0), std::pair(-steep, 0.0), std::pair(0.0, steep)}) {
    WalkingRig rig(GetParam(), {}, SlopeIn(folder, x, y));
    rig.BalanceStand();
    rig.Walk({0.5, 0, 0}, 3);
    const Vector3d speed = rig.Speed({0.5, 0, 0}, 4);
    EXPECT_NEAR(speed.x(), wanted, 0.1) << x << " " << y;
    EXPECT_NEAR(speed.y(), 0, 0.07) << x << " " << y;
    EXPECT_EQ(rig.state().id, kWalking);
  }
}

TEST_P(MoveTest, StepAllocatesNothing) {
  rig_.Walk({0.1, 0, 0}, 0.1);
  const std::uint64_t before = test::Allocations();
  rig_.Ask(goal::Move{0.5, 0.1, 0.3, 1});
  rig_.Run(4);
  EXPECT_EQ(test::Allocations(), before);
}

INSTANTIATE_TEST_SUITE_P(Robots, MoveTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

class WalkTest : public MoveTest {};

TEST_P(WalkTest, GoesNoFasterThanItsFiguresSay) {
  rig_.Walk({100, 0, 0}, 3);
  EXPECT_LT(rig_.Speed({100, 0, 0}, 1).x(), 1.1 * walk().most_speed.x());
}

TEST_P(WalkTest, MarchesAMinute) {
  const Vector3d slow(0.5 * walk().most_speed.x() / 10 + walk().dead_band.x(), 0, 0);
  rig_.Walk(slow, 60);
  EXPECT_EQ(rig_.state().id, kWalking);
  EXPECT_LT(rig_.tilt(), 0.1);
  EXPECT_LT(std::abs(rig_.world().robot().base().p_WB.y()), 0.5);
}

TEST_P(WalkTest, EndsAMoveThatIsNotRenewed) {
  rig_.Walk({0.5, 0, 0}, 2);
  EXPECT_EQ(rig_.state().id, kWalking);
  rig_.Run(0.9);
  EXPECT_GT(rig_.state().v_WB_W.x(), 0.3) << "holds for a second";
  EXPECT_TRUE(rig_.ComesToRest(4));
}

TEST_P(WalkTest, StaysWhereItIsForACommandInTheDeadBand) {
  const Vector3d before = rig_.world().robot().base().p_WB;
  rig_.Walk(0.9 * walk().dead_band, 2);
  EXPECT_EQ(rig_.state().id, kBalance);
  EXPECT_LT((rig_.world().robot().base().p_WB - before).norm(), 0.01);
}

TEST_P(WalkTest, StopsBeforeItDoesWhatOnlyAStandAllows) {
  rig_.Walk({0.4, 0, 0}, 2);
  EXPECT_EQ(rig_.Ask(goal::StandDown{}), authority::MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.RunUntil(kLying, 5));
  rig_.Run(4);
  EXPECT_NEAR(rig_.height(), rig_.spec().lying.height, 0.03);
}

TEST_P(WalkTest, StepsWhenItIsPushedAtRestAndThenStandsAgain) {
  bool stepped = false;
  for (int side = 0; side < 8; ++side) {
    const double way = side * M_PI / 4 + rig_.rpy().z();
    rig_.watch = [&] { stepped = stepped || rig_.state().id == kWalking; };
    rig_.Push(9 * mass() * Vector3d(std::cos(way), std::sin(way), 0), 0.1);
    ASSERT_TRUE(rig_.ComesToRest(5)) << "0.9 N·s/kg from side " << side;
    rig_.watch = {};
    ASSERT_EQ(rig_.state().id, kBalance) << "0.9 N·s/kg from side " << side;
    EXPECT_LT(rig_.tilt(), 0.06);  // a push makes the attitude that it is told lean for seconds
  }
  EXPECT_TRUE(stepped);
}

TEST_P(WalkTest, LeaningAndShiftingIsNoReasonToStep) {
  bool stepped = false;
  rig_.watch = [&] { stepped = stepped || rig_.state().id == kWalking; };
  for (const double way : {1.0, -1.0}) {
    const Vector3d most = way * rig_.spec().motion.quadruped.euler_range;
    rig_.Ask(goal::Euler{most.x(), most.y(), most.z()});
    rig_.Run(1.5);
    rig_.Ask(goal::Euler{});
    rig_.Run(1.5);
    rig_.Ask(goal::BodyPosition{way, way, 0, 0});
    rig_.Run(1.5);
    rig_.Ask(goal::BodyPosition{});
    rig_.Run(1.5);
  }
  EXPECT_FALSE(stepped);
}

TEST_P(WalkTest, CarriesTheBodyAsAsked) {
  rig_.Walk({0.3, 0, 0}, 1);
  rig_.Ask(goal::Euler{0, 0.15, 0});
  rig_.Ask(goal::BodyHeight{-0.04});
  rig_.Walk({0.3, 0, 0}, 3);
  EXPECT_NEAR(rig_.rpy().y(), 0.15, 0.04);
  EXPECT_NEAR(rig_.height(), rig_.spec().motion.quadruped.stand_height - 0.04, 0.02);
}

TEST_P(WalkTest, TellsHowItMovesAsItFeelsIt) {
  const Vector3d from = rig_.world().robot().base().p_WB, told_from = rig_.state().p_WB;
  double error = 0;
  int steps = 0;
  rig_.watch = [&] {
    error += (rig_.state().v_WB_W - rig_.world().robot().base().v_WB_W).squaredNorm();
    ++steps;
  };
  rig_.Walk({0.5, 0.1, 0.3}, 5);
  EXPECT_LT(std::sqrt(error / steps), 0.05);
  EXPECT_EQ(rig_.state().gait, 1);
  const Vector3d way = rig_.world().robot().base().p_WB - from;
  EXPECT_LT((rig_.state().p_WB - told_from - way).norm(), 0.05 * 2.5);
}

TEST_P(WalkTest, IsTheSameAgain) {
  WalkingRig other(GetParam());
  other.BalanceStand();
  for (WalkingRig* rig : {&rig_, &other}) {
    rig->Walk({0.5, 0.1, 0.3}, 2);
    rig->Push({0, 5 * mass(), 0}, 0.1);
    rig->Walk({-0.3, 0, 0}, 2);
  }
  EXPECT_EQ(rig_.command().motors, other.command().motors);
  EXPECT_EQ(rig_.world().robot().base().p_WB, other.world().robot().base().p_WB);
}

// A real Go2's, on concrete (dimos, its plant.py): gain 0.922, 0.395 s, dead time
// 0.065 s. The step that is nearest to the trot's in the least squares.
TEST(Go2WalkTest, AnswersAStepAsARealOneDoes) {
  WalkingRig rig("go2");
  rig.BalanceStand();
  std::vector<double> speed;
  rig.watch = [&] { speed.push_back(rig.world().robot().base().v_WB_W.x()); };
  rig.Walk({0.5, 0, 0}, 4);
  double gain = 0, constant = 0, dead = 0, least = 1e9;
  for (double late = 0; late < 0.2; late += 0.005) {
    for (double tau = 0.2; tau < 0.8; tau += 0.01) {
      double fit = 0, square = 0, error = 0;
      const auto at = [&](std::size_t i) {
        const double t = 0.001 * static_cast<double>(i + 1) - late;
        return t > 0 ? 1 - std::exp(-t / tau) : 0;
      };
      for (std::size_t i = 0; i < speed.size(); ++i) {
        fit += at(i) * speed[i];
        square += at(i) * at(i);
      }
      for (std::size_t i = 0; i < speed.size(); ++i) {
        const double off = fit / square * at(i) - speed[i];
        error += off * off;
      }
      if (error > least) continue;
      least = error;
      gain = fit / square / 0.5;
      constant = tau;
      dead = late;
    }
  }
  EXPECT_NEAR(gain, 0.922, 0.15 * 0.922);
  EXPECT_NEAR(constant, 0.395, 0.15 * 0.395);
  EXPECT_NEAR(dead, 0.065, 0.15 * 0.065);
}

class DriveTest : public MoveTest {};

TEST_P(DriveTest, RollsAheadAndBackAndThroughBends) {
  for (const Vector3d& wish :
       {Vector3d(0.5, 0, 0), Vector3d(1.2, 0, 0), Vector3d(-1, 0, 0), Vector3d(0.8, 0, 0.15)}) {
    rig_.Walk(wish, 5);
    const Vector3d speed = rig_.Speed(wish, 3);
    EXPECT_NEAR(speed.x(), wish.x(), std::max(0.03, 0.1 * std::abs(wish.x())));
    EXPECT_NEAR(speed.z(), wish.z(), 0.06);
    EXPECT_LT(rig_.tilt(), 0.1);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      EXPECT_NEAR(rig_.world().robot().q()[3 * leg + 1], rig_.spec().standing.q[1], 0.4)
          << "legs stand, they do not step";
    }
  }
}

TEST_P(DriveTest, StepsSidewaysAndThroughSharpBendsWithBrakedWheels) {
  for (const Vector3d& wish :
       {Vector3d(0, 0.3, 0), Vector3d(0, -0.3, 0), Vector3d(0, 0, 0.8), Vector3d(0.4, 0, 0.5)}) {
    rig_.Walk(wish, 4);
    const Vector3d speed = rig_.Speed(wish, 3);
    EXPECT_NEAR(speed.x(), wish.x(), 0.05);
    EXPECT_NEAR(speed.y(), wish.y(), 0.04);
    EXPECT_NEAR(speed.z(), wish.z(), 0.08);
    EXPECT_LT(rig_.tilt(), 0.1);
  }
}

TEST_P(DriveTest, StepsWhenItIsPushedAsideAndDrivesOn) {
  for (const double way : {1.0, -1.0}) {
    rig_.Walk({0.8, 0, 0}, 4);
    const double wheels_at = rig_.rpy().z();
    rig_.Push(way * 6 * mass() * Vector3d(-std::sin(wheels_at), std::cos(wheels_at), 0), 0.1);
    rig_.Walk({0.8, 0, 0}, 8);
    EXPECT_EQ(rig_.state().id, kWalking);
    EXPECT_LT(rig_.tilt(), 0.1);
    EXPECT_NEAR(rig_.Speed({0.8, 0, 0}, 2).x(), 0.8, 0.08);
  }
}

TEST_P(DriveTest, RollsAgainFiveSecondsAfterItSteppedAside) {
  rig_.Walk({0, 0.3, 0}, 3);
  rig_.Walk({1, 0, 0}, 5);
  double bent = 0;
  rig_.watch = [&] {
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const double off = rig_.world().robot().q()[3 * leg + 1] - rig_.spec().standing.q[1];
      bent = std::max(bent, std::abs(off));
    }
  };
  EXPECT_NEAR(rig_.Speed({1, 0, 0}, 2).x(), 1, 0.25);
  EXPECT_LT(bent, 0.4) << "legs stand, they do not step";
}

TEST_P(DriveTest, StepsWhenItIsPushedAtRestAndThenStandsAgain) {
  for (int side = 0; side < 8; ++side) {
    const double way = side * M_PI / 4 + rig_.rpy().z();
    rig_.Push(6 * mass() * Vector3d(std::cos(way), std::sin(way), 0), 0.1);
    ASSERT_TRUE(rig_.ComesToRest(6)) << "0.6 N·s/kg from side " << side;
    ASSERT_EQ(rig_.state().id, kBalance) << "0.6 N·s/kg from side " << side;
  }
}

// A change between rolling and stepping takes a stop: one that is asked for again and again must
// not keep the robot in its place.
TEST_P(DriveTest, GetsAheadThroughBendsThatAreNowSharpNowWide) {
  const Vector3d from = rig_.world().robot().base().p_WB;
  for (int bend = 0; bend < 12; ++bend) rig_.Walk({0.6, 0, bend % 2 == 0 ? 0.3 : 0}, 1);
  EXPECT_GT((rig_.world().robot().base().p_WB - from).norm(), 0.5 * 0.6 * 12);
}

TEST_P(DriveTest, ComesToRestAndStaysThere) {
  rig_.Walk({0.8, 0, 0}, 3);
  rig_.Ask(goal::StopMove{});
  EXPECT_TRUE(rig_.ComesToRest(5));
  rig_.Run(1);
  const Vector3d before = rig_.world().robot().base().p_WB;
  rig_.Run(2);
  EXPECT_LT((rig_.world().robot().base().p_WB - before).norm(), 0.02);
}

INSTANTIATE_TEST_SUITE_P(Robots, DriveTest, testing::ValuesIn(test::WheeledRobots()),
                         [](const auto& test) { return test.param; });

INSTANTIATE_TEST_SUITE_P(Robots, WalkTest, testing::ValuesIn(Legged()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
