#include "sensors/imu_unit.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::sensors {
namespace {

using Eigen::Vector3d;

constexpr double kDt = 0.001;
const Vector3d kGravity(0, 0, -9.81);

class ImuUnitTest : public testing::Test {
 protected:
  ImuUnit Make(const char* name = "imu") const {
    ImuUnit unit(config_, spec_, name, kImuStream, kDt);
    unit.Restart(rest_, kGravity);
    return unit;
  }
  robot::ImuReading Run(ImuUnit* unit, const robot::ImuReading& truth, int steps) const {
    for (int i = 0; i < steps; ++i) unit->Step(truth, fault_, 25);
    robot::ImuReading reading;
    unit->Read(fault_, &reading);
    return reading;
  }
  robot::ImuReading AtRest(int steps = 1) const {
    ImuUnit unit = Make();
    return Run(&unit, rest_, steps);
  }
  // The deviation of the axes of f() over many seeds.
  template <class F>
  double Deviation(F of) {
    constexpr int kSeeds = 300;
    double square = 0;
    for (config_.seed = 0; config_.seed < kSeeds; ++config_.seed) square += of().squaredNorm();
    return std::sqrt(square / (3 * kSeeds));
  }

  SensorConfig config_{.quantise = false, .noise = false};
  robot::ImuSpec spec_{.site = "imu",
                       .secondary_site = "",
                       .gyro_step = 1.0 / 1024,
                       .accel_step = 1.0 / 256,
                       .temperature_c = 80};
  robot::ImuReading rest_{.f_WI_I = -kGravity};
  robot::ImuEffects fault_;
};

double Yaw(const robot::ImuReading& reading) {
  const Vector3d x = reading.R_WI * Vector3d::UnitX();
  return std::atan2(x.y(), x.x());
}

TEST_F(ImuUnitTest, TellsTheTruthWithoutErrors) {
  ImuUnit unit = Make();
  const robot::ImuReading truth{
      .R_WI = Eigen::Quaterniond(0.8, 0.6, 0, 0), .w_WI_I = {1, 2, 3}, .f_WI_I = {4, 5, 6}};
  const robot::ImuReading reading = Run(&unit, truth, 1);
  EXPECT_EQ(reading.R_WI.coeffs(), truth.R_WI.coeffs());
  EXPECT_EQ(reading.w_WI_I, truth.w_WI_I);
  EXPECT_EQ(reading.f_WI_I, truth.f_WI_I);
  EXPECT_EQ(reading.temperature_c, 80);
}

TEST_F(ImuUnitTest, HasABiasThatIsItsOwnAndLasts) {
  config_.imu.gyro_bias = 0.02;
  config_.imu.accel_bias = 0.3;
  EXPECT_NEAR(Deviation([this] { return AtRest().w_WI_I; }), 0.02, 0.0015);
  EXPECT_NEAR(Deviation([this] { return Vector3d(AtRest().f_WI_I + kGravity); }), 0.3, 0.025);
  EXPECT_EQ(AtRest(1).w_WI_I, AtRest(500).w_WI_I);
  ImuUnit other = Make("secondary_imu");
  EXPECT_NE(Run(&other, rest_, 1).w_WI_I, AtRest().w_WI_I);
}

TEST_F(ImuUnitTest, WalksAwayFromItsBiasWithTheRootOfTime) {
  config_.imu.gyro_walk = 0.2;
  config_.imu.accel_walk = 0.4;
  EXPECT_NEAR(Deviation([this] { return AtRest(250).w_WI_I; }), 0.1, 0.008);
  EXPECT_NEAR(Deviation([this] { return AtRest(1000).w_WI_I; }), 0.2, 0.016);
  EXPECT_NEAR(Deviation([this] { return Vector3d(AtRest(1000).f_WI_I + kGravity); }), 0.4, 0.032);
}

TEST_F(ImuUnitTest, ScalesItsAxesAndMixesThem) {
  config_.imu.gyro_scale = 0.05;
  config_.imu.gyro_misalignment = 0.01;
  const auto column = [this](int axis) {
    robot::ImuReading truth = rest_;
    truth.w_WI_I = Vector3d::Unit(axis);
    ImuUnit unit = Make();
    return Run(&unit, truth, 1).w_WI_I;
  };
  // The diagonal has one deviation, what is beside it the other.
  EXPECT_NEAR(
      Deviation([&] { return Vector3d(column(0)[0] - 1, column(1)[1] - 1, column(2)[2] - 1); }),
      0.05, 0.004);
  EXPECT_NEAR(Deviation([&] { return Vector3d(column(0)[1], column(1)[2], column(2)[0]); }), 0.01,
              0.0008);
  EXPECT_NEAR(Deviation([&] { return Vector3d(column(1)[0], column(2)[1], column(0)[2]); }), 0.01,
              0.0008);
  config_.imu = {.accel_scale = 0.05};
  EXPECT_EQ(column(0), Vector3d::UnitX());
  EXPECT_NE(AtRest().f_WI_I, rest_.f_WI_I);
}

TEST_F(ImuUnitTest, EndsWhereSixteenBitsOfItsLatticeEnd) {
  config_.imu.saturate = true;
  ImuUnit unit = Make();
  const robot::ImuReading truth{.w_WI_I = {100, -100, 1}, .f_WI_I = {1000, -1000, 10}};
  const robot::ImuReading reading = Run(&unit, truth, 1);
  EXPECT_EQ(reading.w_WI_I, Vector3d(32767.0 / 1024, -32767.0 / 1024, 1));
  EXPECT_EQ(reading.f_WI_I, Vector3d(32767.0 / 256, -32767.0 / 256, 10));
  spec_.gyro_step = 0;
  ImuUnit boundless = Make();
  EXPECT_EQ(Run(&boundless, truth, 1).w_WI_I, truth.w_WI_I);
}

TEST_F(ImuUnitTest, IsLateByWholeSteps) {
  config_.imu.latency = 0.0031;
  ImuUnit unit = Make();
  Run(&unit, rest_, 10);
  robot::ImuReading turning = rest_;
  turning.R_WI = Eigen::Quaterniond(0, 1, 0, 0);
  turning.w_WI_I = {1, 0, 0};
  for (int i = 0; i < 3; ++i) EXPECT_EQ(Run(&unit, turning, 1).w_WI_I, Vector3d::Zero()) << i;
  EXPECT_EQ(Run(&unit, rest_, 1).w_WI_I, turning.w_WI_I);
  EXPECT_EQ(Run(&unit, rest_, 1).R_WI.x(), 1);
  EXPECT_EQ(Run(&unit, rest_, 1).w_WI_I, turning.w_WI_I);
  EXPECT_EQ(Run(&unit, rest_, 1).w_WI_I, Vector3d::Zero());
}

TEST_F(ImuUnitTest, PassesLowFrequencies) {
  config_.imu.bandwidth = 20;
  ImuUnit unit = Make();
  EXPECT_EQ(Run(&unit, rest_, 10).f_WI_I, rest_.f_WI_I) << "it has been at rest for long";
  robot::ImuReading turning = rest_;
  turning.w_WI_I = {1, 0, 0};
  EXPECT_NEAR(Run(&unit, turning, 10).w_WI_I.x(), 1 - std::exp(-2 * 3.14159265 * 20 * 0.01), 1e-6);
}

TEST_F(ImuUnitTest, HasWhiteNoiseOnAllThatItReads) {
  config_.noise = true;
  config_.noise_gain = 2;
  spec_.gyro_noise = 0.01;
  spec_.accel_noise = 0.05;
  config_.imu.bandwidth = 1;  // the figures are of what it puts out
  EXPECT_NEAR(Deviation([this] { return AtRest().w_WI_I; }), 0.02, 0.0015);
  EXPECT_NEAR(Deviation([this] { return Vector3d(AtRest().f_WI_I + kGravity); }), 0.1, 0.008);
}

TEST_F(ImuUnitTest, HasTheNoiseOfAFaultTenTimesAsMuchInItsAccelerations) {
  config_.noise = false;
  fault_.noise = 0.1;
  EXPECT_NEAR(Deviation([this] { return AtRest().w_WI_I; }), 0.1, 0.0075);
  EXPECT_NEAR(Deviation([this] { return Vector3d(AtRest().f_WI_I + kGravity); }), 1, 0.08);
}

TEST_F(ImuUnitTest, TurnsItsHeadingAwayByItsBiasTimesTime) {
  config_.imu.attitude = AttitudeSource::kFilter;
  config_.imu.gyro_bias = 0.002;
  for (const int seed : {1, 2, 3}) {
    config_.seed = seed;
    const robot::ImuReading reading = AtRest(20'000);
    EXPECT_NEAR(Yaw(reading), 20 * reading.w_WI_I.z(), 2e-3) << seed;
  }
}

TEST_F(ImuUnitTest, TurnsItsHeadingAwayByTheOffsetOfAFaultTheSameWay) {
  config_.imu.attitude = AttitudeSource::kFilter;
  fault_.rate = 0.001;
  EXPECT_NEAR(Yaw(AtRest(20'000)), 0.02, 1e-3);
}

TEST_F(ImuUnitTest, LeansAsTheBiasOfItsAccelerometerSays) {
  config_.imu.attitude = AttitudeSource::kFilter;
  config_.imu.accel_bias = 0.5;
  for (const int steps : {1, 30'000}) {
    const robot::ImuReading reading = AtRest(steps);
    EXPECT_TRUE(
        (reading.R_WI.conjugate() * Vector3d::UnitZ()).isApprox(reading.f_WI_I.normalized(), 1e-6))
        << steps;
    EXPECT_GT((reading.R_WI * Vector3d::UnitZ() - Vector3d::UnitZ()).norm(), 0.01);
  }
}

TEST_F(ImuUnitTest, FindsTheVerticalWhereGravityIs) {
  config_.imu.attitude = AttitudeSource::kFilter;
  rest_.f_WI_I = {0, 1, 9.76};
  ImuUnit unit(config_, spec_, "imu", kImuStream, kDt);
  unit.Restart(rest_, {0, -1, -9.76});
  const Vector3d up_I = Run(&unit, rest_, 1).R_WI.conjugate() * Vector3d::UnitZ();
  EXPECT_TRUE(up_I.isApprox(rest_.f_WI_I.normalized(), 1e-9));
}

TEST_F(ImuUnitTest, GetsWarmFromTheAirWithItsTimeConstantAndStaysSoAtARestart) {
  config_.imu.warm_up = 2;
  ImuUnit unit = Make();
  EXPECT_NEAR(Run(&unit, rest_, 1).temperature_c, 25, 0.1);
  const double after = Run(&unit, rest_, 1999).temperature_c;
  EXPECT_NEAR(after, 80 - 55 * std::exp(-1), 1e-6);
  unit.Restart(rest_, kGravity);
  EXPECT_GT(Run(&unit, rest_, 1).temperature_c, after);
}

TEST_F(ImuUnitTest, RepeatsBitForBitForASeed) {
  config_.noise = true;
  spec_.gyro_noise = 0.01;
  config_.imu = {.gyro_bias = 0.01, .gyro_walk = 0.1, .attitude = AttitudeSource::kFilter};
  const robot::ImuReading first = AtRest(100), second = AtRest(100);
  EXPECT_EQ(first.w_WI_I, second.w_WI_I);
  EXPECT_EQ(first.R_WI.coeffs(), second.R_WI.coeffs());
  config_.seed = 2;
  EXPECT_NE(AtRest(100).R_WI.coeffs(), first.R_WI.coeffs());
}

TEST_F(ImuUnitTest, BeginsAnewWithItsBiasesBehindItsLowPassAndItsLatency) {
  config_.imu = {.gyro_bias = 0.02,
                 .gyro_walk = 0.5,
                 .accel_bias = 0.3,
                 .accel_walk = 5,
                 .accel_scale = 0.05,
                 .bandwidth = 5,
                 .latency = 0.003};
  ImuUnit walked = Make();
  Run(&walked, rest_, 2000);
  config_.imu.gyro_walk = config_.imu.accel_walk = 0;
  const robot::ImuReading settled = AtRest(2000);
  EXPECT_EQ(AtRest(1).w_WI_I, settled.w_WI_I);
  EXPECT_TRUE(AtRest(1).f_WI_I.isApprox(settled.f_WI_I, 1e-12));
  const robot::ImuReading before = Run(&walked, rest_, 1);
  EXPECT_GT((before.w_WI_I - settled.w_WI_I).norm(), 0.1);
  EXPECT_GT((before.f_WI_I - settled.f_WI_I).norm(), 1);
  walked.Apply(config_);
  walked.Restart(rest_, kGravity);
  for (const int steps : {1, 200}) {
    const robot::ImuReading after = Run(&walked, rest_, steps);
    EXPECT_TRUE(after.w_WI_I.isApprox(settled.w_WI_I, 1e-12)) << steps;
    EXPECT_TRUE(after.f_WI_I.isApprox(settled.f_WI_I, 1e-12)) << steps;
  }
}

TEST_F(ImuUnitTest, GoesOnWithOtherErrorsAsIfItHadHadThemFromTheStart) {
  spec_.gyro_noise = 0.01;
  const SensorConfig before = config_;
  config_.noise = true;
  config_.quantise = true;
  config_.noise_gain = 2;
  config_.imu = {.gyro_bias = 0.02,
                 .gyro_scale = 0.05,
                 .gyro_misalignment = 0.02,
                 .accel_bias = 0.3,
                 .accel_scale = 0.05,
                 .accel_misalignment = 0.02,
                 .saturate = true,
                 .warm_up = 2};
  robot::ImuReading truth = rest_;
  truth.w_WI_I = {1, 2, 100};
  ImuUnit one = Make();
  const robot::ImuReading wanted = Run(&one, truth, 1);
  ImuUnit other(before, spec_, "imu", kImuStream, kDt);
  other.Restart(rest_, kGravity);
  other.Apply(config_);
  const robot::ImuReading told = Run(&other, truth, 1);
  EXPECT_EQ(told.w_WI_I, wanted.w_WI_I);
  EXPECT_EQ(told.f_WI_I, wanted.f_WI_I);
  EXPECT_EQ(told.temperature_c, wanted.temperature_c);
  EXPECT_EQ(told.w_WI_I.z(), 32767.0 / 1024);
}

TEST_F(ImuUnitTest, GoesOnWithOtherGainsOfItsFilter) {
  config_.imu.attitude = AttitudeSource::kFilter;
  config_.imu.attitude_gain = 0;
  config_.imu.attitude_trim = 0;
  ImuUnit unit = Make();
  robot::ImuReading pressed = rest_;
  pressed.f_WI_I = {1, 0, 9.8};
  EXPECT_EQ(Run(&unit, pressed, 1000).R_WI.y(), 0);
  config_.imu.attitude_gain = 1;
  unit.Apply(config_);
  EXPECT_LT(Run(&unit, pressed, 1000).R_WI.y(), -0.02);
}

TEST_F(ImuUnitTest, TakesTheOffsetOfAFaultForARateAndNotForAnAcceleration) {
  fault_.rate = 0.5;
  EXPECT_EQ(AtRest().w_WI_I, Vector3d::Constant(0.5));
  EXPECT_EQ(AtRest().f_WI_I, rest_.f_WI_I);
}

// Their streams are apart, so that the one is not the other's echo.
TEST_F(ImuUnitTest, WalksByOtherChanceThanItIsNoisyBy) {
  config_.imu.gyro_walk = 1 / std::sqrt(kDt);
  const Vector3d walk = AtRest().w_WI_I;
  config_.imu.gyro_walk = 0;
  config_.noise = true;
  spec_.gyro_noise = 1;
  const Vector3d noise = AtRest().w_WI_I;
  EXPECT_GT((walk - noise).norm(), 0.1);
}

}  // namespace
}  // namespace understudy::sensors
