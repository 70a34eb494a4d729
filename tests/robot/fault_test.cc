// What each row of the table of faults does to the effects, by itself.
#include "robot/fault.h"

#include <cctype>
#include <cmath>
#include <initializer_list>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

Effects Nothing() {
  Effects effects;
  effects.motors.resize(2);
  effects.encoders.resize(2);
  effects.feet.resize(1);
  effects.links.resize(1);
  effects.services.resize(1);
  effects.buses.resize(1);
  effects.fans.resize(1);
  effects.cameras.resize(1);
  effects.hands.resize(1);
  return effects;
}

double Is(bool so) { return so ? 1 : 0; }

void Add(std::vector<double>* all, std::initializer_list<double> values) {
  all->insert(all->end(), values);
}

// All that effects say, as numbers.
std::vector<double> Flat(const Effects& effects) {
  std::vector<double> all;
  for (const MotorEffects& e : effects.motors) {
    Add(&all, {e.torque_share, e.drag, e.heat_c, Is(e.jammed), Is(e.silent), Is(e.unheard)});
  }
  for (const EncoderEffects& e : effects.encoders) {
    Add(&all, {Is(e.dead), Is(e.stuck), Is(e.garbage), e.offset, e.noise});
  }
  for (const ImuEffects& e : effects.imus) {
    Add(&all, {Is(e.dead), Is(e.stuck), e.rate, e.tilt, e.turn, e.noise});
  }
  for (const FootEffects& e : effects.feet) Add(&all, {Is(e.stuck), e.share, e.offset});
  Add(&all, {effects.battery.resistance, effects.battery.most_charge, Is(effects.remote_off)});
  for (const LinkEffects& e : effects.links) {
    Add(&all, {Is(e.drops), Is(e.doubles), Is(e.damages), Is(e.reorders), e.delay});
  }
  for (const ServiceEffects& e : effects.services) Add(&all, {Is(e.off), e.delay});
  for (const BusEffects& e : effects.buses) Add(&all, {Is(e.drops), e.delay});
  for (const FanEffects& e : effects.fans) all.push_back(e.share);
  Add(&all, {Is(effects.board.dead), Is(effects.board.mute), effects.board.heat_c});
  const LidarEffects& lidar = effects.lidar;
  Add(&all, {Is(lidar.dead), Is(lidar.blind), lidar.lost, lidar.dirt, lidar.noise});
  for (const CameraEffects& e : effects.cameras)
    Add(&all, {Is(e.frozen), Is(e.lost), e.light, e.noise});
  for (const HandEffects& e : effects.hands) all.push_back(Is(e.dead));
  return all;
}

class FaultTest : public testing::TestWithParam<FaultKind> {
 protected:
  void Act(double grown, double age, Effects* effects, double chance = 0) const {
    const FaultKind& kind = GetParam();
    kind.act({.element = 0,
              .by = kind.otherwise,
              .grown = grown,
              .age = age,
              .chance = chance,
              .motors = motors_},
             effects);
  }

  std::vector<std::size_t> motors_{1};
};

TEST_P(FaultTest, DoesSomethingAndToItsElementAlone) {
  Effects effects = Nothing();
  Act(1, 1, &effects, GetParam().name == "jittery" ? 0.5 : 0);
  EXPECT_NE(Flat(effects), Flat(Nothing()));
  const std::size_t other = GetParam().of == Component::kBus ? 0 : 1;
  EXPECT_EQ(effects.motors[other].torque_share, 1);
  EXPECT_FALSE(effects.motors[other].unheard);
}

// One without a magnitude has nothing that could grow.
TEST_P(FaultTest, IsNothingWhereItsRampBeginsIfItHasAMagnitude) {
  Effects effects = Nothing();
  Act(0, 0, &effects);
  EXPECT_EQ(Flat(effects) == Flat(Nothing()), GetParam().has_magnitude());
}

TEST_P(FaultTest, AddsToWhatIsWrongBesideIt) {
  Effects once = Nothing();
  Act(1, 1, &once, 0.05);
  Effects twice = once;
  Act(1, 1, &twice, 0.05);
  // What is lost is lost, and a charge that has gone has gone.
  const bool loses_pictures = GetParam().of == Component::kCamera && GetParam().name == "lossy";
  const bool shares_messages =
      loses_pictures || (GetParam().unit.empty() &&
                         (GetParam().of == Component::kTopic || GetParam().of == Component::kBus));
  const bool counts = GetParam().has_magnitude() && !shares_messages && GetParam().name != "empty";
  EXPECT_EQ(Flat(twice) != Flat(once), counts);
}

std::string Titled(const testing::TestParamInfo<FaultKind>& info) {
  std::string title = std::to_string(info.index) + "_";
  for (const char c : std::string(info.param.name)) title += std::isalnum(c) != 0 ? c : '_';
  return title;
}

INSTANTIATE_TEST_SUITE_P(OfEveryKind, FaultTest,
                         testing::ValuesIn(FaultKinds().begin(), FaultKinds().end()), Titled);

const FaultKind& KindOf(Component of, std::string_view name) {
  for (const FaultKind& kind : FaultKinds()) {
    if (kind.of == of && kind.name == name) return kind;
  }
  throw std::runtime_error("no such kind");
}

TEST(FaultKindTest, AnOldPackThatGetsOlderMultipliesItsResistance) {
  Effects effects = Nothing();
  const FaultKind& weak = KindOf(Component::kBattery, "weak");
  weak.act({.by = 3}, &effects);
  weak.act({.by = 3, .grown = 0.5}, &effects);
  EXPECT_EQ(effects.battery.resistance, 3 * 2);
}

TEST(FaultKindTest, OfTwoChargesThatAreLeftTheLesserHolds) {
  Effects effects = Nothing();
  const FaultKind& empty = KindOf(Component::kBattery, "empty");
  empty.act({.by = 0.1}, &effects);
  empty.act({.by = 0.5}, &effects);
  EXPECT_DOUBLE_EQ(effects.battery.most_charge, 0.1);
}

TEST(FaultKindTest, WhatDriftsIsOffByItsRateTimesItsAge) {
  Effects effects = Nothing();
  KindOf(Component::kImu, "drifting").act({.by = 0.5, .age = 3}, &effects);
  KindOf(Component::kEncoder, "drifting").act({.by = 0.25, .age = 3}, &effects);
  EXPECT_EQ(effects.imus[0].turn, 1.5);
  EXPECT_EQ(effects.encoders[0].offset, 0.75);
}

TEST(FaultKindTest, TimesOfJitterAreOfAnExponentialDistribution) {
  for (const Component of : {Component::kTopic, Component::kBus}) {
    Effects effects = Nothing();
    KindOf(of, "jittery").act({.by = 0.01, .chance = 0.5}, &effects);
    const double delay = effects.links[0].delay + effects.buses[0].delay;
    EXPECT_DOUBLE_EQ(delay, 0.01 * std::log(2)) << "the median";
  }
}

}  // namespace
}  // namespace understudy::robot
