#include "drive/command_transport.h"

#include <map>
#include <random>
#include <span>
#include <vector>

#include <gtest/gtest.h>

namespace understudy::drive {
namespace {

constexpr double kDt = 0.001;

robot::RobotCommand Torque(double tau) {
  const robot::MotorCommand motor{.enabled = true, .tau = tau};
  return {.motors = {motor, motor, motor}};
}

// Three motors, of which the first is on a bus of its own and the last is a hand's.
robot::RobotSpec Spec(double delay = 0, std::array<double, 2> of_bus = {0, 0}) {
  robot::RobotSpec spec;
  spec.motors = {{.joint = "a", .slot = 0}, {.joint = "b", .slot = 1}};
  spec.hands = {{.name = "left", .topic = "left", .motors = {{.joint = "c"}}}};
  spec.buses = {{.name = "leg", .slots = {0}, .delay = of_bus}};
  spec.dynamics.delay = delay;
  return spec;
}

// Sends the torques 1, 2, 3 ..., one per step.
class Sender {
 public:
  explicit Sender(const robot::RobotSpec& spec, int seed = 1)
      : transport_(spec, kDt, seed, Torque(0)) {}

  // What a motor follows after each of them.
  std::vector<double> Send(int times, std::size_t motor = 0,
                           std::span<const robot::BusEffects> faults = {}) {
    std::vector<double> come;
    for (int i = 0; i < times; ++i) {
      const robot::RobotCommand sent = Torque(++sent_);
      come.push_back(transport_.Pass(sent, sent_ * kDt, faults).motors[motor].tau);
    }
    return come;
  }
  CommandTransport& transport() { return transport_; }

 private:
  CommandTransport transport_;
  int sent_ = 0;
};

TEST(CommandTransportTest, PassesEachCommandOnAtOnceAndAsItIsWhereNothingTakesTime) {
  CommandTransport transport(Spec(), kDt, 1, Torque(0));
  EXPECT_EQ(transport.Pass(Torque(7), 0).motors, Torque(7).motors);
}

TEST(CommandTransportTest, GivesEachCommandAfterItsDelayAndTheStartCommandBefore) {
  EXPECT_EQ(Sender(Spec(0.002)).Send(5), (std::vector<double>{0, 0, 1, 2, 3}));
}

TEST(CommandTransportTest, LeavesMotorsWithoutACommandWhenItIsCleared) {
  Sender sender(Spec(0.002));
  sender.Send(3);
  sender.transport().Clear();
  EXPECT_EQ(sender.transport().followed().motors, std::vector<robot::MotorCommand>(3));
  EXPECT_EQ(sender.Send(3), (std::vector<double>{0, 0, 4}));
}

TEST(CommandTransportTest, ForgetsWhatIsUnderWayWhenTheRobotStartsAnew) {
  Sender sender(Spec(0.002));
  sender.Send(3);
  sender.transport().Restart(Torque(9));
  EXPECT_EQ(sender.Send(3), (std::vector<double>{9, 9, 4}));
}

TEST(CommandTransportTest, DrawsTheTimeOfEachCommandOfABusFromItsRangeAndKeepsTheirOrder) {
  Sender sender(Spec(0.001, {0.002, 0.006}));
  std::map<int, int> ages;
  double before = 0;
  for (int i = 1; i <= 5000; ++i) {
    const double come = sender.Send(1)[0];
    EXPECT_GE(come, before);
    if (i > 20) ++ages[static_cast<int>(i - come)];
    before = come;
  }
  EXPECT_GE(ages.begin()->first, 3);
  EXPECT_LE(ages.rbegin()->first, 7);
  EXPECT_GE(ages.size(), 3U);
}

TEST(CommandTransportTest, DrawsForEachBusByItself) {
  robot::RobotSpec spec = Spec(0, {0.001, 0.009});
  spec.buses.push_back({.name = "other", .slots = {1}, .delay = {0.001, 0.009}});
  EXPECT_NE(Sender(spec).Send(200, 0), Sender(spec).Send(200, 1));
}

TEST(CommandTransportTest, DelaysOnlyTheMotorsOfTheBus) {
  Sender sender(Spec(0, {0.003, 0.003}));
  sender.Send(10);
  EXPECT_EQ(sender.Send(1, 1)[0], 11);
  EXPECT_EQ(sender.Send(1, 2)[0], 12);
  EXPECT_EQ(sender.Send(1, 0)[0], 10);
}

TEST(CommandTransportTest, DrawsTheSameForEqualSeedsAndOtherwiseForOthers) {
  const robot::RobotSpec spec = Spec(0, {0, 0.005});
  EXPECT_EQ(Sender(spec, 3).Send(200), Sender(spec, 3).Send(200));
  EXPECT_NE(Sender(spec, 3).Send(200), Sender(spec, 4).Send(200));
}

TEST(CommandTransportTest, LeavesMotorsWithTheLastCommandThatCameWhileTheirBusDropsAll) {
  Sender sender(Spec());
  sender.Send(3);
  const std::vector<robot::BusEffects> fault{{}, {.drops = true}, {}};
  EXPECT_EQ(sender.Send(3, 2, fault), (std::vector<double>{3, 3, 3}));
  EXPECT_EQ(sender.Send(1, 2)[0], 7);
}

// As a fault `lost` does: each drop is drawn by itself.
TEST(CommandTransportTest, LosesTheShareOfCommandsThatIsDropped) {
  for (const double share : {0.05, 0.3}) {
    Sender sender(Spec());
    std::mt19937_64 random(7);
    int dropped = 0, lost = 0;
    for (int i = 1; i <= 10000; ++i) {
      const bool drops = static_cast<double>(random() >> 11U) * 0x1p-53 < share;
      const std::vector<robot::BusEffects> fault{{.drops = drops}, {}, {}};
      if (drops) ++dropped;
      if (sender.Send(1, 0, fault)[0] != i) ++lost;
    }
    EXPECT_EQ(lost, dropped) << share;
    EXPECT_NEAR(lost, 10000 * share, 200);
  }
}

TEST(CommandTransportTest, KeepsTheJointSpaceOfTheCommandThatABusCarriedLast) {
  CommandTransport transport(Spec(), kDt, 1, Torque(0));
  const std::vector<robot::BusEffects> fault{{.drops = true}, {}, {}};
  transport.Pass(Torque(1), 0);
  robot::RobotCommand motors = Torque(2);
  for (robot::MotorCommand& motor : motors.motors) motor.space = robot::JointSpace::kMotors;
  const robot::RobotCommand& come = transport.Pass(motors, kDt, fault);
  EXPECT_EQ(come.motors[0].space, robot::JointSpace::kPitchRoll);
  EXPECT_EQ(come.motors[0].tau, 1);
  EXPECT_EQ(come.motors[1].space, robot::JointSpace::kMotors);
  EXPECT_EQ(come.motors[1].tau, 2);
}

TEST(CommandTransportTest, AddsWhatAFaultOfTheBusTakesAndThenCatchesUp) {
  Sender sender(Spec());
  sender.Send(1);
  const std::vector<robot::BusEffects> fault{{.delay = 0.002}, {}, {}};
  EXPECT_EQ(sender.Send(4, 0, fault), (std::vector<double>{1, 1, 2, 3}));
  EXPECT_EQ(sender.Send(1)[0], 4);
}

}  // namespace
}  // namespace understudy::drive
