#include "robot/fault_bank.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/fixture_robot.h"

namespace understudy::robot {
namespace {

class FaultBankTest : public testing::Test {
 protected:
  // Returns the words of the refusal, "" if it began.
  std::string Begin(std::string_view component, std::string_view kind, const FaultTimes& times = {},
                    double t = 0) {
    return bank_.Begin(component, kind, nullptr, times, t).why();
  }
  std::string BeginBy(std::string_view component, std::string_view kind, double by,
                      const FaultTimes& times = {}) {
    return bank_.Begin(component, kind, &by, times, 0).why();
  }
  const MotorEffects& motor() const { return bank_.effects().motors[1]; }
  const EncoderEffects& encoder() const { return bank_.effects().encoders[1]; }

  RobotSpec spec_ = test::FixtureRobot();
  FaultBank bank_{spec_, {"rt/lowcmd", "", "rt/lowstate"}, {"sport"}, 1};
  std::string joint_ = spec_.motors[1].joint;
};

TEST_F(FaultBankTest, HasNoEffectsBeforeTheFirstFault) {
  bank_.Step(1);
  EXPECT_FALSE(bank_.any());
  EXPECT_EQ(motor().torque_share, 1);
  EXPECT_EQ(encoder().offset, 0);
}

TEST_F(FaultBankTest, BeginsEachKindThatItOffersForAComponentAndNoOther) {
  for (std::size_t i = 0; i < bank_.components().size(); ++i) {
    const auto offered = bank_.KindsOf(i);
    for (const std::string_view name : FaultNames()) {
      if (name == kNoFault) continue;
      FaultBank fresh(spec_, {"rt/lowcmd", "", "rt/lowstate"}, {"sport"}, 1);
      const bool begins = fresh.Begin(bank_.components()[i], name, nullptr, {}, 0).why().empty();
      EXPECT_EQ(begins, std::ranges::count(offered, name, &FaultKind::name) == 1)
          << bank_.components()[i] << ' ' << name;
    }
  }
}

TEST_F(FaultBankTest, ActsOnThatComponentAndNoOther) {
  ASSERT_EQ(Begin(joint_, "limp"), "");
  bank_.Step(0);
  EXPECT_EQ(motor().torque_share, 0);
  EXPECT_EQ(bank_.effects().motors[0].torque_share, 1);
  EXPECT_EQ(encoder().offset, 0);
}

TEST_F(FaultBankTest, AddsUpDifferentFaultsOfAComponent) {
  ASSERT_EQ(BeginBy(joint_ + ".encoder", "offset", 0.5), "");
  ASSERT_EQ(BeginBy(joint_ + ".encoder", "drifting", 0.1), "");
  bank_.Step(2);
  EXPECT_DOUBLE_EQ(encoder().offset, 0.7);
}

TEST_F(FaultBankTest, BeginsAFaultAnewInsteadOfHavingItTwice) {
  ASSERT_EQ(BeginBy(joint_ + ".encoder", "offset", 0.5), "");
  ASSERT_EQ(BeginBy(joint_ + ".encoder", "offset", 0.2), "");
  bank_.Step(0);
  EXPECT_EQ(bank_.faults().size(), 1U);
  EXPECT_DOUBLE_EQ(encoder().offset, 0.2);
}

TEST_F(FaultBankTest, GrowsOverItsRamp) {
  ASSERT_EQ(BeginBy(joint_, "weak", 0.2, {.ramp = 4}), "");
  bank_.Step(0);
  EXPECT_DOUBLE_EQ(motor().torque_share, 1);
  bank_.Step(1);
  EXPECT_DOUBLE_EQ(motor().torque_share, 0.8);
  bank_.Step(9);
  EXPECT_DOUBLE_EQ(motor().torque_share, 0.2);
}

TEST_F(FaultBankTest, IsOverAfterItsTimeAndSaysSoOnce) {
  ASSERT_EQ(Begin(joint_, "limp", {.lasts = 2}, 1), "");
  bank_.Step(2.999);
  EXPECT_EQ(motor().torque_share, 0);
  EXPECT_TRUE(bank_.over().empty());
  bank_.Step(3);
  EXPECT_EQ(motor().torque_share, 1);
  ASSERT_EQ(bank_.over().size(), 1U);
  EXPECT_EQ(bank_.components()[bank_.over()[0].component], joint_);
}

TEST_F(FaultBankTest, ClearsOneComponentOrAll) {
  ASSERT_EQ(Begin(joint_, "limp"), "");
  ASSERT_EQ(Begin("battery", "weak"), "");
  ASSERT_EQ(Begin("imu", "off"), "");
  bank_.Step(0);
  ASSERT_TRUE(bank_.Clear("imu").ok());
  bank_.Step(0);
  EXPECT_TRUE(bank_.effects().imus[0].fine());
  EXPECT_EQ(motor().torque_share, 0);
  ASSERT_TRUE(bank_.Clear("all").ok());
  EXPECT_EQ(bank_.over().size(), 2U);
  EXPECT_EQ(motor().torque_share, 1);  // at once
}

TEST_F(FaultBankTest, ComesAndGoesLikeALooseContact) {
  ASSERT_EQ(Begin(joint_, "limp", {.probability = 0.3}), "");
  int there = 0, changes = 0;
  bool before = false;
  for (int ms = 0; ms < 100'000; ++ms) {
    bank_.Step(ms * 1e-3);
    const bool now = motor().torque_share == 0;
    there += now ? 1 : 0;
    changes += now != before ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(there / 1e5, 0.3, 0.05);
  EXPECT_LT(changes, 1000);  // at most one in a tenth of a second
  EXPECT_GT(changes, 200);
}

TEST_F(FaultBankTest, LosesThatShareOfMessagesTickByTick) {
  ASSERT_EQ(BeginBy("rt/lowstate", "lost", 0.25), "");
  int lost = 0;
  for (int ms = 0; ms < 20'000; ++ms) {
    bank_.Step(ms * 1e-3);
    lost += bank_.effects().links[2].drops ? 1 : 0;
    EXPECT_FALSE(bank_.effects().links[0].drops);
  }
  EXPECT_NEAR(lost / 2e4, 0.25, 0.01);
}

TEST_F(FaultBankTest, DrawsTheSameForEqualSeedsAndOtherwiseForOthers) {
  const auto drawn = [this](int seed) {
    FaultBank bank(spec_, {"rt/lowcmd"}, {}, seed);
    EXPECT_TRUE(bank.Begin("rt/lowcmd", "lost", nullptr, {}, 0).ok());
    std::string drops;
    for (int ms = 0; ms < 200; ++ms) {
      bank.Step(ms * 1e-3);
      drops += bank.effects().links[0].drops ? 'x' : '.';
    }
    return drops;
  };
  EXPECT_EQ(drawn(7), drawn(7));
  EXPECT_NE(drawn(7), drawn(8));
}

// Of two alike in everything but that, over 200 ticks.
TEST_F(FaultBankTest, HasTopicsOfServicesBehindAllOtherComponents) {
  FaultBank bank(spec_, {"rt/lowcmd", "rt/lowstate"}, {"sport"}, 1, {"rt/api/sport/response"});
  const std::vector<std::string>& names = bank.components();
  EXPECT_EQ(names.back(), "rt/api/sport/response");
  // So each other component draws as it would without them.
  const FaultBank without(spec_, {"rt/lowcmd", "rt/lowstate"}, {"sport"}, 1);
  EXPECT_EQ(without.components(), std::vector<std::string>(names.begin(), names.end() - 1));
  ASSERT_EQ(bank.Begin("rt/api/sport/response", "off", nullptr, {}, 0).why(), "");
  bank.Step(0);
  ASSERT_EQ(bank.effects().links.size(), 3U);
  EXPECT_TRUE(bank.effects().links[2].drops);
  EXPECT_FALSE(bank.effects().links[1].drops);
}

TEST_F(FaultBankTest, DrawsForEachComponentAndKindByItself) {
  ASSERT_EQ(BeginBy("rt/lowcmd", "lost", 0.5), "");
  ASSERT_EQ(BeginBy("rt/lowstate", "lost", 0.5), "");
  ASSERT_EQ(BeginBy("rt/lowstate", "doubled", 0.5), "");
  std::string lost, of_another, doubled;
  for (int ms = 0; ms < 200; ++ms) {
    bank_.Step(ms * 1e-3);
    lost += bank_.effects().links[2].drops ? 'x' : '.';
    of_another += bank_.effects().links[0].drops ? 'x' : '.';
    doubled += bank_.effects().links[2].doubles ? 'x' : '.';
  }
  EXPECT_NE(lost, of_another);
  EXPECT_NE(lost, doubled);
}

TEST_F(FaultBankTest, RefusesAComponentThatIsNotThereWithTheNearest) {
  EXPECT_EQ(Begin("imv", "off"), "the robot has no 'imv'; did you mean 'imu'?");
  EXPECT_EQ(Begin("flux capacitor", "off"),
            "the robot has no 'flux capacitor'; expected a joint, JOINT.encoder, imu, foot.NAME, "
            "battery, remote, a topic, service.NAME, bus.NAME, fan.NAME, mainboard, mcu, lidar, "
            "camera.NAME or hand.NAME");
  EXPECT_NE(bank_.Clear("imv").why(), "");
}

TEST_F(FaultBankTest, RefusesAFaultThatSuchAComponentNeverHasWithThoseItHas) {
  EXPECT_EQ(Begin("battery", "limp"), "'limp' is no fault of a battery; valid: weak, empty");
}

TEST_F(FaultBankTest, RefusesMagnitudesBeyondTheKindsLimits) {
  EXPECT_EQ(BeginBy(joint_, "weak", 2), "by: expected 0 to 1 for 'weak', found 2");
  EXPECT_EQ(BeginBy(joint_, "hot", -1), "by: expected 0 to 200 °C for 'hot', found -1");
  EXPECT_EQ(BeginBy(joint_, "limp", 1), "by: expected nothing for 'limp', found 1");
  EXPECT_FALSE(bank_.any());
}

TEST_F(FaultBankTest, RefusesMoreFaultsThanItHasRoomFor) {
  std::string refusal;
  for (const MotorSpec& one : spec_.motors) {
    for (const FaultKind& kind : FaultKinds()) {
      if (kind.of == Component::kMotor) refusal += Begin(one.joint, kind.name);
      if (kind.of == Component::kEncoder) refusal += Begin(one.joint + ".encoder", kind.name);
    }
  }
  EXPECT_NE(refusal, "");
  EXPECT_EQ(bank_.faults().size(), FaultBank::kMost);
  EXPECT_EQ(Begin("rt/lowstate", "off"), "as many faults as there can be are there");
}

TEST_F(FaultBankTest, KeepsRoomForWhatIsPlanned) {
  for (std::size_t i = 0; i + 1 < FaultBank::kMost; ++i) {
    ASSERT_TRUE(bank_.Plan({.component = "imu", .fault = "off", .at = 9}).ok());
  }
  EXPECT_EQ(Begin("battery", "weak"), "");
  EXPECT_EQ(Begin("battery", "empty"), "as many faults as there can be are there");
  EXPECT_EQ(Begin("battery", "weak"), "") << "that one is there";
}

TEST_F(FaultBankTest, BeginsWhatIsPlannedInItsOrderAndSaysSoOnce) {
  ASSERT_TRUE(bank_.Plan({.component = "imu", .fault = "off", .at = 2}).ok());
  ASSERT_TRUE(bank_.Plan({.component = joint_, .fault = "weak", .by = 0.25, .at = 1}).ok());
  EXPECT_FALSE(bank_.Step(0.999));
  EXPECT_FALSE(bank_.any());
  EXPECT_TRUE(bank_.Step(1));
  ASSERT_EQ(bank_.begun().size(), 1U);
  EXPECT_EQ(motor().torque_share, 0.25);
  EXPECT_TRUE(bank_.Step(1.5));
  EXPECT_TRUE(bank_.begun().empty());
  bank_.Step(3);
  ASSERT_EQ(bank_.begun().size(), 1U);
  EXPECT_EQ(bank_.components()[bank_.begun()[0].component], "imu");
}

TEST_F(FaultBankTest, BeginsWhatIsPlannedForOneTimeAsItWasPlanned) {
  for (const char* fault : {"weak", "hot", "limp"}) {
    ASSERT_TRUE(bank_.Plan({.component = joint_, .fault = fault, .at = 1}).ok());
  }
  bank_.Step(1);
  std::string begun;
  for (const Fault& fault : bank_.begun()) begun += std::string(fault.kind->name) + " ";
  EXPECT_EQ(begun, "weak hot limp ");
}

TEST_F(FaultBankTest, RefusesToPlanWhatItWouldNotBegin) {
  EXPECT_NE(bank_.Plan({.component = "imv", .fault = "off"}).why(), "");
  EXPECT_EQ(bank_.Plan({.component = joint_, .fault = "weak", .by = 2}).why(),
            "by: expected 0 to 1 for 'weak', found 2");
  for (std::size_t i = 0; i < FaultBank::kMost; ++i) {
    ASSERT_TRUE(bank_.Plan({.component = "imu", .fault = "off", .at = 1.0}).ok());
  }
  EXPECT_FALSE(bank_.Plan({.component = "imu", .fault = "off", .at = 1.0}).ok());
}

TEST_F(FaultBankTest, HasWhatMessagesOfTheFamilyCanShow) {
  RobotSpec hg = spec_;
  hg.family = WireFamily::kHg;
  FaultBank bank(hg, {}, {}, 1);
  EXPECT_TRUE(bank.Begin("mainboard", "off", nullptr, {}, 0).ok());
  EXPECT_EQ(bank.Begin("mainboard", "hot", nullptr, {}, 0).why(),
            "'hot' is no fault of a mainboard; valid: off");
  EXPECT_FALSE(bank.Begin("mcu", "off", nullptr, {}, 0).ok());
  EXPECT_EQ(Begin("mainboard", "hot"), "");
  EXPECT_EQ(Begin("mcu", "off"), "");
}

TEST(HandProgramFaultTest, StopsAllTopicsOfItsHandAndNoOther) {
  const RobotSpec spec = test::FixtureRobotWithHand();
  const std::string topic = "rt/" + spec.hands[0].topic;
  const std::string slow = "rt/lf/" + spec.hands[0].topic;
  FaultBank bank(
      spec, {"rt/lowcmd", topic + "/cmd", topic + "/state", slow + "/state", topic + "r/x"}, {}, 1);
  ASSERT_TRUE(bank.Begin("hand.neck", "off", nullptr, {.lasts = 1}, 0).ok());
  bank.Step(0);
  EXPECT_TRUE(bank.effects().hands[0].dead);
  std::vector<bool> drops;
  for (const LinkEffects& link : bank.effects().links) drops.push_back(link.drops);
  EXPECT_EQ(drops, (std::vector<bool>{false, true, true, true, false}));
  bank.Step(1);
  EXPECT_FALSE(bank.effects().hands[0].dead);
  EXPECT_FALSE(bank.effects().links[1].drops);
}

TEST(HandProgramFaultTest, KnowsItsSideWhereTopicsEndWithIt) {
  RobotSpec spec = test::FixtureRobotWithHand();
  spec.hands[0].topic = "hands/*/l";
  FaultBank bank(
      spec, {"rt/hands/ctrl/l", "rt/hands/state/l", "rt/hands/touch/l", "rt/hands/state/r"}, {}, 1);
  ASSERT_TRUE(bank.Begin("hand.neck", "off", nullptr, {}, 0).ok());
  bank.Step(0);
  std::vector<bool> drops;
  for (const LinkEffects& link : bank.effects().links) drops.push_back(link.drops);
  EXPECT_EQ(drops, (std::vector<bool>{true, true, true, false}));
}

TEST(BusesTest, AreThoseOfTheDescriptionThenOfHandsThenOfAllOtherMotors) {
  RobotSpec spec = test::FixtureRobotWithHand();
  spec.buses = {{.name = "front", .slots = {0, 1, 30}, .delay = {0.001, 0.002}}};
  const std::vector<MotorBus> buses = BusesOf(spec);
  ASSERT_EQ(buses.size(), 3U);
  EXPECT_EQ(buses[0].name, "front");
  EXPECT_EQ(buses[0].motors, (std::vector<std::size_t>{0, 1}));
  EXPECT_EQ(buses[0].delay[1], 0.002);
  EXPECT_EQ(buses[1].name, "neck_hand");
  EXPECT_EQ(buses[1].motors, (std::vector<std::size_t>{4, 5}));
  EXPECT_EQ(buses[2].name, "");
  EXPECT_EQ(buses[2].motors, (std::vector<std::size_t>{2, 3}));
}

TEST(FaultKindsTest, AreNamedOncePerComponentAndHaveALaw) {
  for (const FaultKind& kind : FaultKinds()) {
    int same = 0;
    for (const FaultKind& other : FaultKinds()) {
      same += kind.of == other.of && kind.name == other.name ? 1 : 0;
    }
    EXPECT_EQ(same, 1) << kind.name;
    EXPECT_NE(kind.act, nullptr) << kind.name;
    EXPECT_NE(kind.name, kNoFault);
    if (!kind.has_magnitude()) continue;
    EXPECT_GE(kind.otherwise, kind.low) << kind.name;
    EXPECT_LE(kind.otherwise, kind.high) << kind.name;
  }
}

}  // namespace
}  // namespace understudy::robot
