#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "robot/motor.h"

namespace understudy::robot {
namespace {

// Heat of 0.1 W/(N·m)², which rises by 0.2 °C/W in the winding and by 0.8 in the casing.
MotorTypeSpec Type() {
  return {.name = "type",
          .rated_v = 40,
          .watt_per_nm2 = 0.1,
          .winding_c_per_w = 0.2,
          .casing_c_per_w = 0.8,
          .winding_time = 10,
          .casing_time = 100};
}

// Three motors; 1 and 2 are the pitch and roll of a parallel joint.
RobotSpec Spec() {
  RobotSpec spec;
  spec.motor_types = {Type()};
  spec.motors.resize(3, MotorSpec{.joint = {}, .torque_limit = 1000, .type = "type"});
  spec.parallel = {{.pitch = 1, .roll = 2, .roll_ratio = 2}};
  spec.thermal = {.ambient_c = 20, .rest_rise_c = 5};
  return spec;
}

RobotCommand Torques(double first, double second, double third) {
  RobotCommand command;
  for (const double tau : {first, second, third}) {
    command.motors.push_back({.enabled = true, .tau = tau});
  }
  return command;
}

class MotorBankTest : public testing::Test {
 protected:
  static constexpr double kDt = 0.05;  // two steps to a period of heat

  std::span<const double> Step(MotorBank* bank, const RobotCommand& command) {
    return bank->Step({.command = command, .q = q_, .dq = dq_});
  }
  std::vector<double> TorquesOf(MotorBank* bank, const RobotCommand& command) {
    const auto tau = Step(bank, command);
    return {tau.begin(), tau.end()};
  }
  void Work(MotorBank* bank, const RobotCommand& command, double seconds) {
    for (int i = 0; i < std::lround(seconds / kDt); ++i) Step(bank, command);
  }
  // The temperature at which the winding ends, by watts and a resistance that grows with it.
  static double Hot(double watt, double c_per_w) {
    double rise = 0;
    for (int i = 0; i < 100; ++i) rise = c_per_w * watt * (1 + 0.00393 * rise);
    return 25 + rise;
  }

  const RobotSpec spec_ = Spec();
  MotorBank bank_{spec_, kDt};
  std::vector<double> q_ = {0, 0, 0};
  std::vector<double> dq_ = {0, 0, 0};
};

TEST_F(MotorBankTest, GivesNoTorqueBeforeTheFirstStep) {
  EXPECT_EQ(std::vector(bank_.torque().begin(), bank_.torque().end()),
            (std::vector<double>{0, 0, 0}));
}

TEST_F(MotorBankTest, KeepsMotorOrderInPitchRoll) {
  const auto tau = Step(&bank_, Torques(1, 2, 3));
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(tau.data(), bank_.torque().data());
}

TEST_F(MotorBankTest, CutsEachMotorToItsOwnLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 5;
  MotorBank bank(spec, kDt);
  const auto tau = Step(&bank, Torques(9, 9, -9));
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{5, 9, -9}));
}

TEST_F(MotorBankTest, GivesOfAFaultyMotorTheShareOfItsFault) {
  std::vector<MotorEffects> faults(3);
  faults[0].torque_share = 0.25;
  const auto tau = bank_.Step({.command = Torques(2, 2, 3), .q = q_, .dq = dq_, .faults = faults});
  EXPECT_EQ(tau[0], 0.5);
  EXPECT_EQ(tau[1], 2);
  EXPECT_EQ(tau[2], 3);
}

// Pitch 8 and roll 8 are 6 of A and 2 of B: without B 6 of pitch and, through the ratio of 2, 12 of
// roll are left.
TEST_F(MotorBankTest, LosesOfAPairTheMotorThatIsFaulty) {
  std::vector<MotorEffects> faults(3);
  faults[1].torque_share = 0;  // B is in pitch's place
  const auto tau = bank_.Step({.command = Torques(0, 8, 8), .q = q_, .dq = dq_, .faults = faults});
  EXPECT_EQ(tau[1], 6);
  EXPECT_EQ(tau[2], 12);
}

// A and B have 10 N·m each. Pitch 20 takes all of both, so that no roll is left beside it.
TEST_F(MotorBankTest, LimitsTheMotorsOfAPairAndNotItsJoints) {
  RobotSpec spec = Spec();
  spec.motors[1].torque_limit = 20;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 50, 0)), (std::vector<double>{0, 20, 0}));
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 0, 90)), (std::vector<double>{0, 0, 40}));
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 20, 40)), (std::vector<double>{0, 10, 20}));
  spec.motors[2].torque_limit = 30;  // of the joint
  MotorBank weaker(spec, kDt);
  EXPECT_EQ(TorquesOf(&weaker, Torques(0, 0, 90)), (std::vector<double>{0, 0, 30}));
}

// At twice the joint's torque per motor, and half of what they are meant to give.
TEST_F(MotorBankTest, LimitsTheJointOfAPairByWhatItsMotorIsMadeToGive) {
  RobotSpec spec = Spec();
  spec.motors[2].torque_limit = 30;
  for (MotorSpec& motor : spec.motors) motor.strength = 0.5;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 0, 90)), (std::vector<double>{0, 0, 15}));
}

// At pitch 6, roll 4 rad/s A turns at 14 and B at -2: half of A's torque is left beyond its knee.
TEST_F(MotorBankTest, LimitsAMotorOfAPairByItsOwnSpeed) {
  RobotSpec spec = Spec();
  spec.motors[1].torque_limit = 20;
  spec.motors[1].knee_speed = 12;
  spec.motors[1].no_load_speed = 16;
  MotorBank bank(spec, kDt);
  dq_ = {0, 6, 4};
  EXPECT_EQ(TorquesOf(&bank, Torques(0, 20, 0)), (std::vector<double>{0, 15, -10}));
}

TEST_F(MotorBankTest, TripsAMotorThatIsTooHotUntilItHasCooled) {
  std::vector<MotorEffects> faults(3);
  const auto torque_at = [&](double celsius) {
    faults[0].heat_c = celsius - 25;
    for (int i = 0; i < 2; ++i) {  // knows the temperature at the end of a period
      bank_.Step({.command = Torques(1e-3, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    return bank_.Step({.command = Torques(1e-3, 0, 0), .q = q_, .dq = dq_, .faults = faults})[0];
  };
  const double trip = spec_.thermal.trip_c;
  EXPECT_EQ(torque_at(trip - 1), 1e-3);
  EXPECT_EQ(torque_at(trip + 1), 0);
  EXPECT_TRUE(bank_.tripped(0));
  EXPECT_FALSE(bank_.tripped(1));
  EXPECT_EQ(torque_at(trip - 9.5), 0);
  EXPECT_EQ(torque_at(trip - 10.5), 1e-3);
}

TEST_F(MotorBankTest, GivesLessTorqueTheHotterItIsDownToHalfWhereItTrips) {
  RobotSpec spec = Spec();
  spec.thermal.derate_c = 100;
  std::vector<MotorEffects> faults(3);
  const auto most_at = [&](double celsius) {
    MotorBank bank(spec, kDt);
    faults[0].heat_c = celsius - 25;
    for (int i = 0; i < 2; ++i) {
      bank.Step({.command = Torques(0, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    EXPECT_EQ(bank.derated(0), celsius > 100);
    return bank.Step({.command = Torques(5000, 0, 0), .q = q_, .dq = dq_, .faults = faults})[0];
  };
  EXPECT_EQ(most_at(99), 1000);
  EXPECT_NEAR(most_at(110), 750, 1e-6);
  EXPECT_NEAR(most_at(119.99), 500, 1);
}

TEST_F(MotorBankTest, MapsMotorSpaceTorquesToTheSerialJoints) {
  RobotCommand command = Torques(1, 2, 3);  // B = 2 is in the pitch slot, A = 3 in the roll slot
  command.joint_space = JointSpace::kMotors;
  const auto tau = Step(&bank_, command);
  EXPECT_EQ(tau[0], 1);  // no part of the pair
  EXPECT_EQ(tau[1], 5);  // A + B
  EXPECT_EQ(tau[2], 2);  // ratio (A - B)
}

TEST_F(MotorBankTest, GivesTheSamePowerOnBothSidesOfAParallelJoint) {
  RobotCommand command = Torques(0, -7, 4);
  command.joint_space = JointSpace::kMotors;
  dq_ = {0, 0.3, -1.1};
  const auto tau = Step(&bank_, command);
  const auto rate = ParallelJoint(spec_.parallel[0]).ToMotors({.pitch = dq_[1], .roll = dq_[2]});
  EXPECT_NEAR(tau[1] * dq_[1] + tau[2] * dq_[2], 4 * rate.a + -7 * rate.b, 1e-12);
}

// The position of A and B at pitch 0.1, roll 0.2 is 0.5 and -0.3: motors that are told to be there
// want nothing.
TEST_F(MotorBankTest, MeasuresAnglesAndRatesInMotorSpace) {
  RobotCommand command;
  command.joint_space = JointSpace::kMotors;
  command.motors = {{},
                    {.enabled = true, .q = -0.3, .dq = -3, .kp = 100, .kd = 10},
                    {.enabled = true, .q = 0.5, .dq = 5, .kp = 100, .kd = 10}};
  q_ = {0, 0.1, 0.2};
  dq_ = {0, 1, 2};
  const auto tau = Step(&bank_, command);
  EXPECT_NEAR(tau[1], 0, 1e-12);
  EXPECT_NEAR(tau[2], 0, 1e-12);
}

// Motors in slots 0 to 2; the fit says 1.5 of kd at the pitch and 0.5 at the roll.
RobotSpec SpecWithKdShares(DynamicsSource use) {
  RobotSpec spec = Spec();
  for (std::size_t i = 0; i < 3; ++i) spec.motors[i].slot = static_cast<int>(i);
  spec.dynamics.use = use;
  spec.dynamics.fitted = {{.slots = {1}, .kd_share = 1.5}, {.slots = {2}, .kd_share = 0.5}};
  return spec;
}

// Every motor is to stand still with kp 0 and kd 10.
RobotCommand Brake() {
  RobotCommand command;
  command.motors.assign(3, {.enabled = true, .kd = 10});
  return command;
}

TEST_F(MotorBankTest, LetsTheFittedShareOfKdActOnEachMotor) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kFitted);
  MotorBank bank(spec, kDt);
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, Brake());
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -15, -5}));
}

TEST_F(MotorBankTest, LetsAllOfKdActUnderCatalogueDynamics) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kCatalogue);
  MotorBank bank(spec, kDt);
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, Brake());
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -10, -10}));
}

// A = pitch + 2 roll turns at 3, B = pitch - 2 roll at -1: -30 and 10 N·m in motor space.
TEST_F(MotorBankTest, LetsAllOfKdActOnMotorsThatAreCommandedThemselves) {
  const RobotSpec spec = SpecWithKdShares(DynamicsSource::kFitted);
  MotorBank bank(spec, kDt);
  RobotCommand command = Brake();
  command.joint_space = JointSpace::kMotors;
  dq_ = {1, 1, 1};
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-10, -20, -80}));
}

TEST_F(MotorBankTest, TakesACommandedAngleBeyondItsClampForTheEnd) {
  RobotSpec spec = Spec();
  for (MotorSpec& motor : spec.motors) motor.q_clamp = {-0.5, 0.25};
  MotorBank bank(spec, kDt);
  const auto of = [&](double q) {
    RobotCommand command = Torques(0, 0, 0);
    for (MotorCommand& motor : command.motors) motor.q = q, motor.kp = 10;
    return TorquesOf(&bank, command);
  };
  EXPECT_EQ(of(0.2), (std::vector<double>{2, 2, 2}));
  EXPECT_EQ(of(0.3), (std::vector<double>{2.5, 2.5, 2.5}));
  EXPECT_EQ(of(-9), (std::vector<double>{-5, -5, -5}));
  EXPECT_EQ(of(kNoPosition), (std::vector<double>{0, 0, 0}));
}

TEST_F(MotorBankTest, ClampsNoAngleOfAPairsOwnMotors) {
  RobotSpec spec = Spec();
  for (MotorSpec& motor : spec.motors) motor.q_clamp = {-0.5, 0.25};
  MotorBank clamping(spec, kDt);
  RobotCommand command = Torques(0, 0, 0);
  command.joint_space = JointSpace::kMotors;
  command.motors[1].q = command.motors[2].q = 0.7;
  command.motors[1].kp = command.motors[2].kp = 10;
  EXPECT_EQ(TorquesOf(&clamping, command), TorquesOf(&bank_, command));
}

TEST_F(MotorBankTest, TakesAnyAngleWithoutAClamp) {
  RobotCommand command = Torques(0, 0, 0);
  command.motors[0].q = 9;
  command.motors[0].kp = 10;
  EXPECT_EQ(Step(&bank_, command)[0], 90);
}

TEST_F(MotorBankTest, IgnoresMotorSpaceWhereNothingIsParallel) {
  RobotSpec spec = Spec();
  spec.parallel.clear();
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(1, 2, 3);
  command.joint_space = JointSpace::kMotors;
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{1, 2, 3}));
}

TEST_F(MotorBankTest, ScalesGainsButNotTorquesThatAreFedForward) {
  RobotSpec spec = Spec();
  spec.motors[0].kp_scale = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(7, 0, 0);
  command.motors[0].q = 1;
  command.motors[0].kp = 100;  // 50 of it
  command.motors[0].kd = 10;   // 30
  dq_[0] = 1;
  EXPECT_EQ(Step(&bank, command)[0], 7 + 50 - 30);
}

TEST_F(MotorBankTest, ScalesGainsInMotorSpaceToo) {
  RobotSpec spec = Spec();
  spec.motors[1].kp_scale = 0.5;  // of B, which is in the pitch slot
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(0, 0, 0);
  command.joint_space = JointSpace::kMotors;
  command.motors[1].q = 1;
  command.motors[1].kp = 100;
  const auto tau = Step(&bank, command);
  EXPECT_EQ(tau[1], 50);
  EXPECT_EQ(tau[2], -100);  // ratio (A - B)
}

TEST_F(MotorBankTest, IsWeakerThanMeantAtAndBelowItsLimit) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 10;
  spec.motors[0].strength = 0.5;
  MotorBank bank(spec, kDt);
  EXPECT_EQ(Step(&bank, Torques(4, 0, 0))[0], 2);
  EXPECT_EQ(Step(&bank, Torques(90, 0, 0))[0], 5);
}

TEST_F(MotorBankTest, BrakesWithItsLockGainWhileNotEnabledWhateverElseItIsTold) {
  RobotSpec spec = Spec();
  spec.motors[0].lock_kd = 0.5;
  spec.motors[0].kd_scale = 3;
  MotorBank bank(spec, kDt);
  RobotCommand command = Torques(NAN, 7, 0);
  command.motors[0].enabled = command.motors[1].enabled = false;
  dq_ = {2, 2, 2};
  const auto tau = Step(&bank, command);
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{-1, 0, 0}));
}

TEST_F(MotorBankTest, StartsAtItsTemperatureOfRest) {
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
}

TEST_F(MotorBankTest, StaysAtItsTemperatureOfRestWhileIdle) {
  Work(&bank_, Torques(0, 0, 0), 1000);
  for (const double temperature : bank_.winding_c()) EXPECT_EQ(temperature, 25);
  for (const double temperature : bank_.casing_c()) EXPECT_EQ(temperature, 25);
}

// The same two masses in small steps: °C of winding and casing over rest after `seconds` of `watt`.
std::array<double, 2> InSmallSteps(double watt, double seconds) {
  const MotorTypeSpec type = Type();
  const double winding_j_per_c = type.winding_time / type.winding_c_per_w;
  const double casing_j_per_c = type.casing_time / type.casing_c_per_w;
  double winding = 0;
  double casing = 0;
  constexpr double kStep = 1e-3;
  for (double t = 0; t < seconds; t += kStep) {
    const double through = (winding - casing) / type.winding_c_per_w;
    winding += (watt * (1 + 0.00393 * winding) - through) * kStep / winding_j_per_c;
    casing += (through - casing / type.casing_c_per_w) * kStep / casing_j_per_c;
  }
  return {winding, casing};
}

// 10 N·m are 10 W.
TEST_F(MotorBankTest, WarmsTheWindingBeforeTheCasing) {
  for (double t = 5; t <= 80; t *= 2) {
    MotorBank bank(spec_, kDt);
    Work(&bank, Torques(-10, 0, 0), t);
    const auto [winding, casing] = InSmallSteps(10, t);
    EXPECT_NEAR(bank.winding_c()[0], 25 + winding, 0.01) << t;
    EXPECT_NEAR(bank.casing_c()[0], 25 + casing, 0.01) << t;
    EXPECT_LT(casing, winding);
  }
  Work(&bank_, Torques(-10, 0, 0), 2000);
  EXPECT_NEAR(bank_.winding_c()[0], Hot(10, 1), 1e-3);
  EXPECT_NEAR(bank_.casing_c()[0], 25 + 0.8 * (Hot(10, 1) - 25), 1e-3);
  EXPECT_EQ(bank_.winding_c()[1], 25);
  EXPECT_EQ(bank_.winding_c()[2], 25);
}

// Whatever the step, the same heat in the same time.
TEST_F(MotorBankTest, IntegratesHeatExactly) {
  MotorBank fine(spec_, 0.001), coarse(spec_, 0.1);
  for (int i = 0; i < 20000; ++i) Step(&fine, Torques(10, 0, 0));
  for (int i = 0; i < 200; ++i) Step(&coarse, Torques(10, 0, 0));
  EXPECT_NEAR(fine.winding_c()[0], coarse.winding_c()[0], 1e-9);
  EXPECT_NEAR(fine.casing_c()[0], coarse.casing_c()[0], 1e-9);
}

TEST_F(MotorBankTest, WarmsByTheTorqueOfTheMotorBeforeTheGear) {
  RobotSpec spec = Spec();
  spec.motors[0].gear = 2;
  MotorBank bank(spec, kDt);
  Work(&bank, Torques(20, 0, 0), 2000);
  EXPECT_NEAR(bank.winding_c()[0], Hot(10, 1), 1e-3);
}

// Pitch 8 and roll 8 are 6 of A and 2 of B.
TEST_F(MotorBankTest, WarmsTheMotorsOfAPairEachByItsOwnTorque) {
  Work(&bank_, Torques(0, 8, 8), 2000);
  EXPECT_NEAR(bank_.winding_c()[1], Hot(0.4, 1), 1e-3);
  EXPECT_NEAR(bank_.winding_c()[2], Hot(3.6, 1), 1e-3);
}

TEST_F(MotorBankTest, WarmsTheCasingByFriction) {
  const std::vector<double> friction = {5, 0, 0};
  for (int i = 0; i < 40000; ++i) {
    bank_.Step({.command = Torques(0, 0, 0), .q = q_, .dq = dq_, .friction_w = friction});
  }
  EXPECT_NEAR(bank_.casing_c()[0], 29, 1e-3);
  EXPECT_NEAR(bank_.winding_c()[0], 29, 1e-3);
  EXPECT_EQ(bank_.casing_c()[1], 25);
}

TEST_F(MotorBankTest, WarmsAWeakMotorByTheCurrentThatItTakesAndALimpOneNot) {
  std::vector<MotorEffects> faults(3);
  for (const double share : {0.25, 0.0}) {
    MotorBank bank(spec_, kDt);
    faults[0].torque_share = share;
    for (int i = 0; i < 40000; ++i) {
      bank.Step({.command = Torques(10, 0, 0), .q = q_, .dq = dq_, .faults = faults});
    }
    EXPECT_NEAR(bank.winding_c()[0], share > 0 ? Hot(10, 1) : 25, 1e-3);
  }
}

// 80 N·m are 640 W, of which half of the torque leaves a quarter: more than it can give off.
TEST_F(MotorBankTest, AStalledMotorDeratesTripsAndComesBack) {
  RobotSpec spec = Spec();
  spec.motors[0].torque_limit = 80;
  MotorBank bank(spec, kDt);
  double derated = -1, tripped = -1, back = -1;
  for (int i = 0; i < 20000; ++i) {
    const double t = i * kDt;
    const bool was_tripped = bank.tripped(0);
    const double tau = Step(&bank, Torques(500, 0, 0))[0];
    EXPECT_EQ(tau == 0, was_tripped);
    if (derated < 0 && tau < 80) derated = t;
    if (tripped < 0 && bank.tripped(0)) tripped = t;
    if (tripped > 0 && back < 0 && !bank.tripped(0)) back = t;
  }
  EXPECT_GT(derated, 5);
  EXPECT_GT(tripped, derated);
  EXPECT_LT(tripped, 60);
  EXPECT_GT(back, tripped);
}

TEST_F(MotorBankTest, LosesTorqueWithTheVoltageOfTheBus) {
  RobotSpec spec = Spec();
  spec.motor_types[0].watt_per_nm2 = 0;  // stays cool
  MotorBank bank(spec, kDt);
  const auto most_at = [&](double voltage) {
    return bank.Step(
        {.command = Torques(5000, 0, 0), .q = q_, .dq = dq_, .supply = {.voltage = voltage}})[0];
  };
  EXPECT_EQ(most_at(50), 1000);
  EXPECT_EQ(most_at(40), 1000);
  EXPECT_FALSE(bank.undervoltage(0));
  EXPECT_EQ(most_at(20), 500);
  EXPECT_TRUE(bank.undervoltage(0));
}

// 10 N·m at 3 rad/s are 30 W of work and 10 W of loss.
TEST_F(MotorBankTest, TakesWorkAndLossesFromTheBus) {
  dq_ = {3, 0, 0};
  Step(&bank_, Torques(10, 0, 0));
  EXPECT_NEAR(bank_.power(), 40, 1e-9);
  Step(&bank_, Torques(-10, 0, 0));
  EXPECT_NEAR(bank_.power(), -20, 1e-9);
}

TEST_F(MotorBankTest, TakesNoMorePowerThanThereIs) {
  dq_ = {3, 0, 0};
  for (const double most : {30.0, 1.0, 0.0}) {
    const auto tau = bank_.Step(
        {.command = Torques(10, 4, 0), .q = q_, .dq = dq_, .supply = {.most_power = most}});
    EXPECT_NEAR(bank_.power(), most, 1e-9);
    EXPECT_NEAR(tau[1], 0.4 * tau[0], 1e-12);
    EXPECT_NEAR(3 * tau[0] + 0.1 * (tau[0] * tau[0] + tau[1] * tau[1] / 2), most, 1e-9);
  }
}

TEST_F(MotorBankTest, WarmsByTheCurrentThatItsShareOfThePowerLeavesIt) {
  const auto winding_with = [&](double most) {
    MotorBank bank(spec_, kDt);
    for (int i = 0; i < 200; ++i) {
      bank.Step({.command = Torques(20, 0, 0), .q = q_, .dq = dq_, .supply = {.most_power = most}});
    }
    return bank.winding_c()[0] - 25;
  };
  EXPECT_NEAR(winding_with(10) / winding_with(1000), 0.25, 0.01);
}

TEST_F(MotorBankTest, GivesNothingOnceTheBusIsOff) {
  const RobotSpec spec = [] {
    RobotSpec ideal = Spec();
    for (MotorSpec& motor : ideal.motors) motor.type = "";
    return ideal;
  }();
  MotorBank bank(spec, kDt);
  const auto tau =
      bank.Step({.command = Torques(1, 2, 3), .q = q_, .dq = dq_, .supply = {.on = false}});
  EXPECT_EQ(std::vector(tau.begin(), tau.end()), (std::vector<double>{0, 0, 0}));
  EXPECT_TRUE(bank.undervoltage(0));
}

TEST_F(MotorBankTest, OutlivesAWorldThatDiverges) {
  const RobotCommand command = Torques(1, 0, 0);
  dq_ = {NAN, 0, 0};
  bank_.Step({.command = command, .q = q_, .dq = dq_, .friction_w = dq_});
  dq_ = {0, 0, 0};
  Work(&bank_, command, 1);
  EXPECT_TRUE(std::isfinite(bank_.winding_c()[0]));
  EXPECT_TRUE(std::isfinite(bank_.power()));
}

}  // namespace
}  // namespace understudy::robot
