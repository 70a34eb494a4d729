#include "sensors/sensors.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include <gtest/gtest.h>

#include "tests/sensors/sensors_fixture.h"

namespace understudy::sensors {
namespace {

// Every number on its lattice to the last bit.
bool OnLattice(double value, double step) { return std::round(value / step) * step == value; }

TEST_F(SensorsTest, KeepTheTruthBesideWhatTheyMeasure) {
  const robot::RobotState so = Sample(kTruth), noisy = Sample(kBoth);
  ASSERT_EQ(noisy.truth.q.size(), so.motors.size());
  for (std::size_t i = 0; i < so.motors.size(); ++i) {
    EXPECT_EQ(noisy.truth.q[i], so.motors[i].q);
    EXPECT_EQ(noisy.truth.dq[i], so.motors[i].dq);
    EXPECT_EQ(noisy.truth.tau[i], so.motors[i].tau);
  }
  EXPECT_EQ(noisy.truth.imu.f_WI_I, so.imu.f_WI_I);
  EXPECT_NE(noisy.imu.f_WI_I, so.imu.f_WI_I);
  EXPECT_EQ(noisy.truth.foot_force, so.foot_force);
}

TEST_F(SensorsTest, TellTheTruthWhenBothAreOff) {
  const robot::RobotState state = Sample(kTruth);
  ASSERT_EQ(state.motors.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(state.motors[i].q, world_.robot().q()[i]);
    EXPECT_EQ(state.motors[i].dq, world_.robot().dq()[i]);
    EXPECT_EQ(state.motors[i].tau, motors_.torque()[i]);
    EXPECT_EQ(state.motors[i].winding_c, motors_.winding_c()[i]);
    EXPECT_EQ(state.motors[i].enabled, i != 2);
  }
  EXPECT_EQ(state.imu.w_WI_I, world_.robot().Imu().w_WI_I);
  EXPECT_EQ(state.imu.f_WI_I, world_.robot().Imu().f_WI_I);
  EXPECT_EQ(state.imu.R_WI.coeffs(), world_.robot().Imu().R_WI.coeffs());
  EXPECT_EQ(state.secondary_imu.f_WI_I, world_.robot().SecondaryImu().f_WI_I);
  EXPECT_EQ(state.base.p_WB, world_.robot().base().p_WB);
  EXPECT_EQ(state.base.v_WB_W, world_.robot().base().v_WB_W);
  EXPECT_EQ(state.battery.voltage, battery_.reading().voltage);
  std::vector<double> force(4);
  world_.robot().FootForces(force);
  EXPECT_EQ(state.foot_force, force);
}

TEST_F(SensorsTest, RoundToTheLatticeToTheLastBit) {
  const robot::RobotState state = Sample(kBoth);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_TRUE(OnLattice(state.motors[i].q, 1.0 / 4096));
    EXPECT_TRUE(OnLattice(state.motors[i].dq, 1.0 / 64));
    EXPECT_TRUE(OnLattice(state.motors[i].tau, 1.0 / 32));
  }
  for (const robot::ImuReading& imu : {state.imu, state.secondary_imu}) {
    for (int i = 0; i < 3; ++i) {
      EXPECT_TRUE(OnLattice(imu.w_WI_I[i], 1.0 / 1024));
      EXPECT_TRUE(OnLattice(imu.f_WI_I[i], 1.0 / 256));
    }
  }
}

TEST_F(SensorsTest, RoundToTheNearestPointOfTheLattice) {
  const robot::RobotState state = Sample(kLattice);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_LE(std::abs(state.motors[i].q - world_.robot().q()[i]), 0.5 / 4096);
    EXPECT_LE(std::abs(state.motors[i].dq - world_.robot().dq()[i]), 0.5 / 64);
    EXPECT_LE(std::abs(state.motors[i].tau - motors_.torque()[i]), 0.5 / 32);
  }
  EXPECT_LE((state.imu.f_WI_I - world_.robot().Imu().f_WI_I).cwiseAbs().maxCoeff(), 0.5 / 256);
}

TEST_F(SensorsTest, LeaveAReadingWithoutALatticeAlone) {
  for (robot::MotorSpec& motor : spec_.motors) motor.q_step = 0;
  const robot::RobotState state = Sample(kLattice);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(state.motors[i].q, world_.robot().q()[i]);
}

TEST_F(SensorsTest, GiveTheSameNoiseForTheSameSeed) {
  Sensors one = Make({.seed = 7});
  Sensors two = Make({.seed = 7});
  for (int i = 0; i < 10; ++i) {
    const robot::RobotState a = Sample(&one);
    const robot::RobotState b = Sample(&two);
    for (std::size_t m = 0; m < 6; ++m) {
      EXPECT_EQ(a.motors[m].q, b.motors[m].q);
      EXPECT_EQ(a.motors[m].dq, b.motors[m].dq);
      EXPECT_EQ(a.motors[m].tau, b.motors[m].tau);
    }
    EXPECT_EQ(a.imu.w_WI_I, b.imu.w_WI_I);
    EXPECT_EQ(a.imu.f_WI_I, b.imu.f_WI_I);
    EXPECT_EQ(a.secondary_imu.f_WI_I, b.secondary_imu.f_WI_I);
  }
}

TEST_F(SensorsTest, GiveOtherNoiseForAnotherSeed) {
  EXPECT_NE(Sample({.quantise = false, .seed = 7}).imu.f_WI_I,
            Sample({.quantise = false, .seed = 8}).imu.f_WI_I);
}

// Mean and standard deviation of one number over 20 000 samples of the same instant. With a right
// sigma the deviation's own error is 0.5 %, so that 2.5 % are five of them; the seed is fixed.
TEST_F(SensorsTest, HaveTheNoiseTheyAreGiven) {
  spec_.encoder_noise.tau = 3.0 / 32;
  struct Reading {
    const char* name;
    double sigma;
    double truth;
    std::function<double(const robot::RobotState&)> value;
  };
  const Reading readings[] = {
      {"q", 2.0 / 4096, world_.robot().q()[1],
       [](const robot::RobotState& s) { return s.motors[1].q; }},
      {"dq", 3.0 / 64, world_.robot().dq()[3],
       [](const robot::RobotState& s) { return s.motors[3].dq; }},
      {"tau", 5.0 / 32, motors_.torque()[0],
       [](const robot::RobotState& s) { return s.motors[0].tau; }},
      {"gyro", 0.01, world_.robot().Imu().w_WI_I.y(),
       [](const robot::RobotState& s) { return s.imu.w_WI_I.y(); }},
      {"accel", 0.05, world_.robot().SecondaryImu().f_WI_I.z(),
       [](const robot::RobotState& s) { return s.secondary_imu.f_WI_I.z(); }},
  };
  constexpr int kSamples = 20'000;
  double sum[std::size(readings)] = {};
  double square[std::size(readings)] = {};
  Sensors sensors = Make(kNoise);
  robot::RobotState state;
  for (int i = 0; i < kSamples; ++i) {
    SampleInto(&sensors, &state);
    for (std::size_t r = 0; r < std::size(readings); ++r) {
      const double error = readings[r].value(state) - readings[r].truth;
      sum[r] += error;
      square[r] += error * error;
    }
  }
  for (std::size_t r = 0; r < std::size(readings); ++r) {
    EXPECT_NEAR(sum[r] / kSamples / readings[r].sigma, 0, 0.035) << readings[r].name;
    EXPECT_NEAR(std::sqrt(square[r] / kSamples) / readings[r].sigma, 1, 0.025) << readings[r].name;
  }
}

TEST_F(SensorsTest, ShowTheTemperaturesOfCasingAndWinding) {
  const robot::RobotState state = Sample(kTruth);
  for (std::size_t i = 0; i < state.motors.size(); ++i) {
    EXPECT_EQ(state.motors[i].casing_c, motors_.casing_c()[i]);
    EXPECT_GT(state.motors[i].casing_c, 20);
    EXPECT_LE(state.motors[i].casing_c, state.motors[i].winding_c);
  }
}

TEST_F(SensorsTest, TellWhatErringEncodersFeetAndThermometersRead) {
  const robot::RobotState truth = Sample(kTruth);
  SensorConfig config = kTruth;
  config.encoder.zero = 0.1;
  encoders_ = Encoders(EncoderZeros(config, spec_), 1);
  config.foot = {.offset = 5, .scale = 0.1, .cross_talk = 0.1};
  config.thermometer.offset_c = 3;
  const std::vector<double> zeros = EncoderZeros(config, spec_);
  const robot::RobotState state = Sample(config);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_DOUBLE_EQ(state.motors[i].q, truth.motors[i].q + zeros[i]);
    EXPECT_EQ(state.motors[i].dq, truth.motors[i].dq);
    EXPECT_NE(state.motors[i].casing_c, truth.motors[i].casing_c);
    EXPECT_DOUBLE_EQ(state.motors[i].casing_c - truth.motors[i].casing_c,
                     state.motors[i].winding_c - truth.motors[i].winding_c);
  }
  const FootSensors feet(config, spec_.feet, 0.001);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_DOUBLE_EQ(state.foot_force[i], feet.Read(i, truth.foot_force));
    EXPECT_NE(state.foot_force[i], truth.foot_force[i]);
  }
}

TEST_F(SensorsTest, DrawTheErrorOfAZeroBesideTheOneThatIsKnown) {
  const std::vector<double> drawn = EncoderZeros({.encoder = {.zero = 0.1}}, spec_);
  spec_.motors[2].zero_error = 0.5;
  const std::vector<double> both = EncoderZeros({.encoder = {.zero = 0.1}}, spec_);
  EXPECT_DOUBLE_EQ(both[2], drawn[2] + 0.5);
  EXPECT_EQ(both[3], drawn[3]);
  EXPECT_NE(drawn[2], drawn[3]);
  EXPECT_NE(EncoderZeros({.seed = 2, .encoder = {.zero = 0.1}}, spec_)[2], drawn[2]);
  EXPECT_EQ(EncoderZeros({}, spec_)[2], 0.5);
}

TEST_F(SensorsTest, GiveTheSecondUnitErrorsOfItsOwn) {
  SensorConfig config = kTruth;
  config.imu.accel_bias = 1;
  const robot::RobotState state = Sample(config);
  const Eigen::Vector3d first = state.imu.f_WI_I - world_.robot().Imu().f_WI_I;
  const Eigen::Vector3d second = state.secondary_imu.f_WI_I - world_.robot().SecondaryImu().f_WI_I;
  EXPECT_GT(first.norm(), 0.1);
  EXPECT_GT(second.norm(), 0.1);
  EXPECT_GT((first - second).norm(), 0.1);
}

TEST_F(SensorsTest, BeginAnewWithTheSameBiasButWithoutItsWalk) {
  SensorConfig config = kTruth;
  config.imu.gyro_bias = 0.1;
  config.imu.gyro_walk = 1;
  config.foot.walk = 100;
  Sensors sensors = Make(config);
  config.imu.gyro_walk = config.foot.walk = 0;
  const robot::RobotState biased = Sample(config);
  robot::RobotState state;
  for (int i = 0; i < 2000; ++i) SampleInto(&sensors, &state);
  EXPECT_GT((state.imu.w_WI_I - biased.imu.w_WI_I).norm(), 0.3);
  EXPECT_GT(std::abs(state.foot_force[0] - biased.foot_force[0]), 10);
  sensors.Restart(instant());
  sensors.Sample(instant(), &state);
  EXPECT_LT((state.imu.w_WI_I - biased.imu.w_WI_I).norm(), 0.2);
  EXPECT_LT(std::abs(state.foot_force[0] - biased.foot_force[0]), 10);
}

TEST_F(SensorsTest, TellMotorsWithoutABus) {
  EXPECT_FALSE(Sample(kTruth).motors[0].undervoltage);
  motors_.Step({.command = command_,
                .q = world_.robot().q(),
                .dq = world_.robot().dq(),
                .supply = {.voltage = 0, .most_power = 0, .on = false}});
  EXPECT_TRUE(Sample(kTruth).motors[0].undervoltage);
}

TEST_F(SensorsTest, ReadHandsWithNoiseAndOnALatticeAsTheBody) {
  spec_.hands = test::FixtureRobotWithHand().hands;
  spec_.motors.resize(4);
  const auto q = [this](const SensorConfig& config) { return Sample(config).motors[5].q; };
  EXPECT_EQ(q(kTruth), world_.robot().q()[5]);
  EXPECT_TRUE(OnLattice(q(kBoth), 1.0 / 4096));
  EXPECT_NE(q(kNoise), q(kTruth));
  EXPECT_EQ(q(kNoise), q(kNoise));
  EXPECT_NE(q(kNoise), q({.quantise = false, .seed = 2}));
}

TEST_F(SensorsTest, LeaveTheNoiseOfTheBodyAsItIsWithoutHands) {
  spec_.motors.resize(4);
  robot::RobotSpec handy = spec_;
  handy.hands = test::FixtureRobotWithHand().hands;
  Sensors one = Make(kNoise), two = Make(kNoise, handy);
  for (int i = 0; i < 3; ++i) {
    const robot::RobotState without = Sample(&one), with = Sample(&two);
    for (std::size_t m = 0; m < 4; ++m) EXPECT_EQ(without.motors[m].tau, with.motors[m].tau);
    EXPECT_EQ(without.imu.f_WI_I, with.imu.f_WI_I);
    EXPECT_NE(with.motors[4].dq, world_.robot().dq()[4]);
  }
}

TEST_F(SensorsTest, ReportTheJointSpaceOfTheCommand) {
  EXPECT_EQ(Sample(kTruth).joint_space, robot::JointSpace::kPitchRoll);
  command_.motors[4].space = command_.motors[5].space = robot::JointSpace::kMotors;
  EXPECT_EQ(Sample(kTruth).joint_space, robot::JointSpace::kMotors);
}

TEST_F(SensorsTest, LeaveTheRemoteAlone) {
  Sensors sensors = Make(kTruth);
  robot::RobotState state;
  state.remote.keys = 42;
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.remote.keys, 42);
}

TEST_F(SensorsTest, LeaveTheSecondUnitAloneWhereThereIsNone) {
  spec_.imu.secondary_site.clear();
  const robot::RobotState state = Sample(kBoth);
  EXPECT_EQ(state.secondary_imu.f_WI_I, Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(state.secondary_imu.temperature_c, 0);
  EXPECT_EQ(state.imu.temperature_c, 40);
}

TEST_F(SensorsTest, LeaveTheReadingsOfAMotorThatDoesNotAnswerAndCountThem) {
  Sensors sensors = Make(kTruth);
  robot::RobotState state = Sample(&sensors);
  state.motors[1].q = 7;
  faults_.motors[1].silent = true;
  SampleInto(&sensors, &state);
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.motors[1].q, 7);
  EXPECT_EQ(state.motors[1].lost, 2U);
  EXPECT_TRUE(state.motors[1].silent);
  EXPECT_EQ(state.motors[0].lost, 0U);
  faults_.motors[1].silent = false;
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.motors[1].q, world_.robot().q()[1]);
  EXPECT_EQ(state.motors[1].lost, 2U);
  EXPECT_FALSE(state.motors[1].silent);
}

TEST_F(SensorsTest, TellAnEncodersErrorOnlyWhereItsBoardCanKnow) {
  faults_.encoders[1].dead = true;
  faults_.encoders[2].offset = 0.3;
  const robot::RobotState state = Sample(kTruth);
  EXPECT_EQ(state.motors[1].q, 0);
  EXPECT_TRUE(state.motors[1].encoder_error);
  EXPECT_DOUBLE_EQ(state.motors[2].q, world_.robot().q()[2] + 0.3);
  EXPECT_FALSE(state.motors[2].encoder_error);
}

TEST_F(SensorsTest, TurnAllThatATiltedUnitReads) {
  faults_.imus[0].tilt = 0.2;
  const robot::RobotState state = Sample(kTruth);
  const robot::ImuReading truth = world_.robot().Imu();
  EXPECT_NEAR(state.imu.R_WI.angularDistance(truth.R_WI), 0.2, 1e-12);
  // In the world it is the same: the unit is turned, not what it measures.
  EXPECT_TRUE((state.imu.R_WI * state.imu.f_WI_I).isApprox(truth.R_WI * truth.f_WI_I, 1e-12));
  EXPECT_TRUE((state.imu.R_WI * state.imu.w_WI_I).isApprox(truth.R_WI * truth.w_WI_I, 1e-12));
  EXPECT_EQ(state.secondary_imu.f_WI_I, world_.robot().SecondaryImu().f_WI_I);
}

TEST_F(SensorsTest, TurnTheHeadingAloneOfAUnitThatDrifts) {
  faults_.imus[0].turn = 0.5;
  const robot::RobotState state = Sample(kTruth);
  const robot::ImuReading truth = world_.robot().Imu();
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  EXPECT_TRUE((state.imu.R_WI.conjugate() * up).isApprox(truth.R_WI.conjugate() * up, 1e-12));
  EXPECT_NEAR(state.imu.R_WI.angularDistance(truth.R_WI), 0.5, 1e-12);
  EXPECT_EQ(state.imu.f_WI_I, truth.f_WI_I);
}

TEST_F(SensorsTest, ReadNothingOfADeadUnitAndTheLastOfAStuckOne) {
  Sensors sensors = Make(kTruth);
  robot::RobotState state = Sample(&sensors);
  state.imu.w_WI_I = {1, 2, 3};
  faults_.imus[0].stuck = true;
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.imu.w_WI_I, Eigen::Vector3d(1, 2, 3));
  faults_.imus[0] = {.dead = true};
  SampleInto(&sensors, &state);
  EXPECT_TRUE(state.imu.w_WI_I.isZero(0));
  EXPECT_TRUE(state.imu.f_WI_I.isZero(0));
  EXPECT_EQ(state.imu.R_WI.w(), 1);
}

TEST_F(SensorsTest, ScaleAndShiftTheForceOfAFoot) {
  std::vector<double> truth(4);
  world_.robot().FootForces(truth);
  faults_.feet[0].share = 0.5;
  faults_.feet[1].offset = 10;
  faults_.feet[2].offset = -1e4;
  const robot::RobotState state = Sample(kTruth);
  EXPECT_DOUBLE_EQ(state.foot_force[0], truth[0] / 2);
  EXPECT_DOUBLE_EQ(state.foot_force[1], truth[1] + 10);
  EXPECT_DOUBLE_EQ(state.foot_force[2], truth[2] - 1e4);
  EXPECT_EQ(state.foot_force[3], truth[3]);
}

}  // namespace
}  // namespace understudy::sensors
