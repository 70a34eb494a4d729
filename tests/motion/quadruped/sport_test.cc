// What the motion service of a quadruped does of what it is asked for, and what it tells.
#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>

#include "motion/quadruped/gaits.h"
#include "motion/quadruped/gestures.h"
#include "tests/motion/quadruped/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using authority::MotionVerdict;
using Eigen::Vector3d;
using goal::GaitName;
using goal::GestureName;

class SportTest : public testing::TestWithParam<std::string> {
 protected:
  // Of the base, by the truth and by the estimate: x, y [m], yaw [rad].
  Vector3d Place() {
    const Vector3d& p = rig_.world().robot().base().p_WB;
    return {p.x(), p.y(), rig_.rpy().z()};
  }
  Vector3d Told() { return {rig_.state().p_WB.x(), rig_.state().p_WB.y(), rig_.rpy().z()}; }
  const robot::WalkSpec& walk() const { return rig_.spec().motion.quadruped.walk; }
  double Fastest(double wish) const {
    return walk().gain.x() * std::min(wish, walk().most_speed.x());
  }

  WalkingRig rig_{GetParam()};
};

TEST_P(SportTest, TellsItsGaitFromWhenItMoves) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.state().id, kBalance);
  rig_.Walk({0.4, 0, 0}, 1);
  EXPECT_EQ(rig_.state().id, kStanding);
  EXPECT_TRUE(rig_.ComesToRest(4));
  EXPECT_EQ(rig_.state().id, kStanding) << "the gait's, not BalanceStand's";
  EXPECT_EQ(rig_.state().mode, 9);
  EXPECT_EQ(rig_.state().gait, 1);
  EXPECT_EQ(rig_.Ask(goal::BalanceStand{}), MotionVerdict::kTaken);
  rig_.Run(1);  // what is left of its way
  EXPECT_EQ(rig_.state().id, kBalance);
}

TEST_P(SportTest, AGaitFreesAStandThatIsLocked) {
  rig_.StandUp();
  EXPECT_EQ(rig_.Ask(goal::Move{0.4, 0, 0, 1}), MotionVerdict::kIgnored);
  rig_.Run(1);
  EXPECT_EQ(rig_.state().id, kLocked);
  EXPECT_EQ(rig_.Ask(goal::Gait{GaitName::kFree}), MotionVerdict::kTaken);
  rig_.Run(1.5);
  EXPECT_EQ(rig_.state().id, kStanding);
  const double x = Place().x();
  rig_.Walk({0.5, 0, 0}, 2);
  EXPECT_GT(Place().x(), x + 0.3);
}

TEST_P(SportTest, TakesNoGaitWhileItLies) {
  rig_.Start("lying");
  EXPECT_EQ(rig_.Ask(goal::Gait{GaitName::kFree}), MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::GoTo{1}), MotionVerdict::kNotNow);
  EXPECT_EQ(rig_.Ask(goal::Gait{GaitName::kNone}), MotionVerdict::kUnknown);
}

TEST_P(SportTest, SpeedLevelsScaleWhatItTakes) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::SpeedLevel{-1}), MotionVerdict::kTaken);
  rig_.Walk({100, 0, 0}, 3);
  EXPECT_NEAR(rig_.Speed({100, 0, 0}, 2).x(), 0.5 * Fastest(100), 0.1);
  for (const auto& [level, speed] : {std::pair(-1, 0.3), std::pair(0, 0.6), std::pair(1, 0.9)}) {
    rig_.Ask(goal::SpeedLevel{level});
    double x = 0;
    for (int i = 0; i < 200; ++i) {
      rig_.Ask(goal::Move{0.6, 0, 0, 0.1, true});
      rig_.Run(0.02);
      if (i == 100) x = Place().x();
    }
    EXPECT_NEAR((Place().x() - x) / 2, Fastest(speed), 0.15 * speed) << "sticks at level " << level;
  }
}

TEST_P(SportTest, StepsOnTheSpotUntilItIsStopped) {
  rig_.BalanceStand();
  const Vector3d before = Place();
  EXPECT_EQ(rig_.Ask(goal::KeepStepping{true}), MotionVerdict::kTaken);
  rig_.Run(1);
  EXPECT_FALSE(rig_.ComesToRest(3));
  EXPECT_LT((Place() - before).norm(), 0.15);
  EXPECT_TRUE(rig_.state().keeps_stepping);
  EXPECT_EQ(rig_.Ask(goal::StopMove{}), MotionVerdict::kTaken);
  EXPECT_TRUE(rig_.ComesToRest(4));
  EXPECT_FALSE(rig_.state().keeps_stepping);
}

TEST_P(SportTest, AMoveLastsWhereItIsToldTo) {
  rig_.BalanceStand();
  EXPECT_EQ(rig_.Ask(goal::LastingMoves{true}), MotionVerdict::kTaken);
  rig_.Ask(goal::Move{0.4, 0, 0, 0.5});
  rig_.Run(4);
  EXPECT_GT(rig_.state().v_WB_W.x(), 0.25);
  rig_.Ask(goal::StopMove{});
  EXPECT_TRUE(rig_.ComesToRest(4));
}

TEST_P(SportTest, GoesToAPlaceFromHereAndBackToWhereItBegan) {
  rig_.BalanceStand();
  const Vector3d before = Place(), told = Told();
  EXPECT_EQ(rig_.Ask(goal::GoTo{1, 0.3, 0.5, true}), MotionVerdict::kTaken);
  rig_.Run(8);
  EXPECT_LT((Told() - told - Vector3d(1, 0.3, 0.5)).norm(), 0.25);
  EXPECT_LT((Place() - before - Vector3d(1, 0.3, 0.5)).norm(), 0.25) << "its estimate drifts";
  EXPECT_TRUE(rig_.ComesToRest(3));
  EXPECT_EQ(rig_.Ask(goal::GoTo{told.x(), told.y(), told.z()}), MotionVerdict::kTaken);
  rig_.Run(8);
  EXPECT_LT((Told() - told).norm(), 0.25);
  EXPECT_TRUE(rig_.ComesToRest(3));
}

TEST_P(SportTest, FollowsAPathInItsTime) {
  rig_.BalanceStand();
  const Vector3d told = Told();
  auto points = std::make_shared<std::vector<goal::PathPoint>>();
  for (int i = 1; i <= 30; ++i) {  // an eighth of a circle with 0.4 m/s
    const double yaw = i * M_PI / 120, radius = 0.4 * 6 / (M_PI / 4);
    points->push_back({0.2 * i, told.x() + radius * std::sin(yaw),
                       told.y() + radius * (1 - std::cos(yaw)), told.z() + yaw});
  }
  EXPECT_EQ(rig_.Ask(goal::FollowPath{points}), MotionVerdict::kTaken);
  double worst = 0;
  for (const goal::PathPoint& point : *points) {
    rig_.Run(0.2);
    worst = std::max(worst, (Told() - Vector3d(point.x, point.y, point.yaw)).norm());
  }
  EXPECT_LT(worst, 0.45) << "starts from rest";
  rig_.Run(2);
  EXPECT_LT((Told() - Vector3d(points->back().x, points->back().y, points->back().yaw)).norm(),
            0.15);
}

TEST_P(SportTest, AMoveEndsAWay) {
  rig_.BalanceStand();
  rig_.Ask(goal::GoTo{5, 0, 0, true});
  rig_.Run(1.5);
  EXPECT_FALSE(rig_.ComesToRest(0.6));
  rig_.Ask(goal::Move{});
  EXPECT_TRUE(rig_.ComesToRest(4));
}

TEST_P(SportTest, TakesNoPathThatIsNone) {
  rig_.BalanceStand();
  using Points = std::vector<goal::PathPoint>;
  EXPECT_EQ(rig_.Ask(goal::FollowPath{}), MotionVerdict::kUnknown);
  for (const Points& points : {Points{{1, 0, 0, 0}, {0.5, 1, 0, 0}}, Points{{1, NAN, 0, 0}}}) {
    EXPECT_EQ(rig_.Ask(goal::FollowPath{std::make_shared<Points>(points)}),
              MotionVerdict::kUnknown);
  }
}

TEST_P(SportTest, DrivesAsItsSticksAreHeld) {
  rig_.BalanceStand();
  struct Stick {
    const char* name;
    Vector3d way;  // what +0.6 of it means: forward, left, turn left
  };
  for (const Stick& stick :
       {Stick{"ly", {1, 0, 0}}, Stick{"lx", {0, -1, 0}}, Stick{"rx", {0, 0, -1}}}) {
    const Vector3d before = Place();
    rig_.Request("remote.sticks", {{stick.name, 0.6}, {"for", 2}});
    rig_.Run(2);
    const Vector3d moved = Eigen::AngleAxisd(-before.z(), Vector3d::UnitZ()) * (Place() - before);
    EXPECT_GT(moved.dot(stick.way), 0.2) << stick.name;
    EXPECT_LT((moved - moved.dot(stick.way) * stick.way).head<2>().norm(), 0.1) << stick.name;
    EXPECT_TRUE(rig_.ComesToRest(4)) << stick.name;
  }
}

TEST_P(SportTest, TellsAFallAndGetsUpFromIt) {
  rig_.BalanceStand();
  rig_.Walk({0.4, 0, 0}, 1);
  rig_.Push(Vector3d(0, 3 * rig_.world().robot().weight(), 0), 0.2);
  ASSERT_TRUE(rig_.RunUntil(kDamped, 3));
  EXPECT_EQ(rig_.state().mode, 7);
  EXPECT_EQ(rig_.Ask(goal::Move{0.4, 0, 0, 1}), MotionVerdict::kNotNow);
  rig_.Run(1);
  EXPECT_EQ(rig_.Ask(goal::RecoveryStand{}), MotionVerdict::kTaken);
  ASSERT_TRUE(rig_.RunUntil(kStanding, 20));
  rig_.Run(1.5);
  EXPECT_LT(rig_.tilt(), 0.05);
  const Vector3d before = Place();
  rig_.Walk({0.5, 0, 0}, 2);
  EXPECT_GT((Place() - before).head<2>().norm(), 0.3) << "and walks on";
}

INSTANTIATE_TEST_SUITE_P(Robots, SportTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

class GaitsTest : public testing::TestWithParam<std::tuple<std::string, GaitName>> {
 protected:
  const GaitRow& row() const { return RowOf(std::get<1>(GetParam())); }
  WalkingRig rig_{std::get<0>(GetParam())};
};

TEST_P(GaitsTest, WalksInItAndTellsIt) {
  rig_.BalanceStand();
  ASSERT_EQ(rig_.Ask(goal::Gait{row().gait}), MotionVerdict::kTaken);
  const robot::WalkSpec& own = rig_.spec().motion.quadruped.walk;
  EXPECT_EQ(rig_.state().id, row().id);
  EXPECT_EQ(rig_.state().mode, row().standing);
  EXPECT_EQ(rig_.state().gait, row().type);
  EXPECT_DOUBLE_EQ(rig_.state().foot_raise, row().raise * own.foot_raise);
  for (const double part : {0.4, 1.0}) {  // of what the gait takes
    for (int axis = 0; axis < 3; ++axis) {
      const double most = row().speed * own.most_speed[axis];
      const Vector3d wish = part * most * Vector3d::Unit(axis);
      rig_.Walk(wish, 2);
      const double speed = rig_.Speed(wish, 2)[axis], wanted = own.gain[axis] * wish[axis];
      if (wish[axis] > own.dead_band[axis]) {
        EXPECT_NEAR(speed, wanted, std::max(0.05, 0.15 * wanted)) << part << " of axis " << axis;
        EXPECT_EQ(rig_.state().mode, row().moving);
      }
      ASSERT_LT(rig_.tilt(), 0.25) << part << " of axis " << axis;
    }
  }
  rig_.Ask(goal::Gait{GaitName::kFree});
  rig_.Walk({0.3, 0, 0}, 1);
  EXPECT_EQ(rig_.state().id, kStanding);
  EXPECT_TRUE(rig_.ComesToRest(4));
}

std::vector<GaitName> AllGaits() {
  std::vector<GaitName> gaits;
  for (const GaitRow& row : GaitRows()) gaits.push_back(row.gait);
  return gaits;
}

INSTANTIATE_TEST_SUITE_P(Robots, GaitsTest,
                         testing::Combine(testing::Values("go2", "b2", "a2"),
                                          testing::ValuesIn(AllGaits())),
                         [](const auto& test) {
                           return std::get<0>(test.param) + "_" +
                                  std::string(RowOf(std::get<1>(test.param)).name);
                         });

TEST(GaitRowsTest, StandInTheOrderOfTheirNames) {
  for (const GaitRow& row : GaitRows()) EXPECT_EQ(&RowOf(row.gait), &row) << row.name;
  EXPECT_EQ(GaitRows().size(), static_cast<std::size_t>(GaitName::kNone));
}

// Of the highest of its feet over the ground, m.
double MostRaised(WalkingRig* rig) {
  rig->Walk({0.3, 0, 0}, 1);  // the gait is taken over at a touchdown
  double most = 0;
  rig->watch = [&] {
    for (const Vector3d& foot : rig->state().feet) {
      most = std::max(most, foot.z() + rig->state().body_height);
    }
  };
  rig->Walk({0.3, 0, 0}, 2);
  rig->watch = {};
  return most;
}

TEST(Go2SportTest, LiftsItsFeetAsHighAsItIsTold) {
  WalkingRig rig("go2");
  rig.BalanceStand();
  const double own = MostRaised(&rig);
  ASSERT_EQ(rig.Ask(goal::FootRaise{0.03}), MotionVerdict::kTaken);
  EXPECT_NEAR(MostRaised(&rig), own + 0.03, 0.01);
  ASSERT_EQ(rig.Ask(goal::Gait{GaitName::kFree}), MotionVerdict::kTaken);
  ASSERT_EQ(rig.Ask(goal::FootRaise{-0.04}), MotionVerdict::kTaken);
  EXPECT_NEAR(MostRaised(&rig), own - 0.04, 0.01);
  EXPECT_EQ(rig.Ask(goal::FootRaise{std::nan("")}), MotionVerdict::kUnknown);
}

class GesturesTest : public testing::TestWithParam<std::string> {};

TEST_P(GesturesTest, AllArePlayedAndEndStanding) {
  for (const GestureName name : {GestureName::kHello, GestureName::kStretch, GestureName::kContent,
                                 GestureName::kDance1, GestureName::kDance2, GestureName::kScrape,
                                 GestureName::kHeart, GestureName::kWiggleHips}) {
    const int number = static_cast<int>(name);
    WalkingRig rig(GetParam());
    rig.MotionRig::Start("standing");
    rig.Run(1.2);
    double tilt = 0, fastest = 0, seconds = 0;
    rig.watch = [&] {
      tilt = std::max(tilt, rig.tilt());
      fastest = std::max(fastest, rig.fastest());
    };
    ASSERT_EQ(rig.Ask(goal::Gesture{name}), MotionVerdict::kTaken) << number;
    EXPECT_EQ(rig.state().id, kGesture);
    EXPECT_EQ(rig.state().progress, 1);
    for (; rig.state().id == kGesture && seconds < 25; seconds += 0.1) rig.Run(0.1);
    EXPECT_EQ(rig.state().id, kStanding) << number;
    EXPECT_GT(fastest, 0.5) << number << ": it moves";
    EXPECT_LT(tilt, 0.7) << number;
    if (name == GestureName::kDance1) {
      EXPECT_NEAR(seconds, 18, 1);
    } else if (name == GestureName::kDance2) {
      EXPECT_NEAR(seconds, 8, 0.5);
    }
    rig.Run(1);
    EXPECT_LT(rig.tilt(), 0.05) << number;
    EXPECT_NEAR(rig.height(), rig.spec().motion.quadruped.stand_height, 0.02) << number;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, GesturesTest, testing::Values("go2", "go2w"),
                         [](const auto& test) { return test.param; });

// Seen on real ones: after power-on, and when mcf is selected again.
TEST(Go2SportTest, IsFoundOnItsFeetInItsGait) {
  MotionRig rig(ConfigOf("go2"));
  rig.Run(0.1);
  EXPECT_EQ(rig.state().id, kStanding);
  rig.Run(2);
  EXPECT_EQ(rig.state().id, kStanding);
  EXPECT_NEAR(rig.height(), 0.33, 0.01);
}

TEST(Go2SportTest, GesturesAndWalksByChords) {
  constexpr std::uint16_t kR1 = 1, kL1 = 2, kStart = 4, kA = 0x100, kB = 0x200;
  MotionRig rig(ConfigOf("go2"));
  rig.Run(2);
  double t = 2;
  const auto press = [&](std::uint16_t keys) {
    rig.robot().remote().Press(keys, t + 0.1);
    rig.Run(0.2);
    t += 0.2;
  };
  press(kL1 | kA);
  EXPECT_EQ(rig.state().id, kGesture);
  EXPECT_TRUE(rig.RunUntil(kStanding, 9));
  t = rig.time();
  press(kStart);
  EXPECT_EQ(rig.state().id, kBalance);
  press(kStart);
  EXPECT_EQ(rig.state().id, kStanding) << "twice: its trot";
  rig.Run(1);
  t = rig.time();
  press(kR1 | kB);
  EXPECT_EQ(rig.state().id, kSit);
}

TEST(Go2SportTest, StandsUpByItselfWhenItsServiceStarts) {
  MotionRig rig(ConfigOf("go2", {"start.pose=lying"}));
  rig.Run(0.1);
  EXPECT_EQ(rig.state().id, kLocked) << "rising";
  EXPECT_TRUE(rig.RunUntil(kStanding, 5));
  rig.Run(1.5);
  EXPECT_NEAR(rig.height(), 0.33, 0.01);
  rig.Start("lying");
  EXPECT_EQ(rig.state().id, kLocked) << "and again";
}

// A B2 was found lying, in mode 7.
TEST(B2SportTest, LiesWhereItsServiceStarts) {
  MotionRig rig(ConfigOf("b2"));
  rig.Run(3);
  EXPECT_EQ(rig.state().mode, 7);
  EXPECT_LT(rig.height(), 0.2);
}

// Vendor's page of the older firmware: 1 balanceStand, 3 locomotion; gait 1 trot.
TEST(OldGo2SportTest, TellsItsModesAsThatFirmwareDid) {
  WalkingRig rig("go2", {"robot.firmware=1.1.5"});
  rig.BalanceStand();
  EXPECT_EQ(rig.state().mode, 1);
  EXPECT_EQ(rig.state().gait, 1);
  EXPECT_DOUBLE_EQ(rig.state().wanted_height, 0.33);
  rig.Walk({0.4, 0, 0}, 1);
  EXPECT_EQ(rig.state().mode, 3);
  rig.Ask(goal::BodyHeight{-0.05});
  EXPECT_DOUBLE_EQ(rig.state().wanted_height, 0.28);
}

}  // namespace
}  // namespace understudy::motion
