#include "config/keys.h"

namespace understudy::config {
namespace {

constexpr Range kShare{0, 1};
constexpr Range kGain{0, 100};

void DescribeImuErrors(Archive& a, sensors::ImuErrors& i) {
  constexpr Range kRate{0, 10};
  constexpr Range kForce{0, 100};
  constexpr Range kTurn{0, 1};
  a.Key(UNDERSTUDY_NVP(i.gyro_bias),
        {"rad/s", kRate, "Bias of the gyroscope at the start: deviation of each axis"});
  a.Key(UNDERSTUDY_NVP(i.gyro_walk),
        {"rad/s/√s", kRate, "Random walk of that bias: its deviation after a second"});
  a.Key(UNDERSTUDY_NVP(i.gyro_scale),
        {"", kShare, "Error of the gyroscope's scale: deviation of each axis, as a share"});
  a.Key(UNDERSTUDY_NVP(i.gyro_misalignment),
        {"rad", kTurn, "How far each axis of the gyroscope leans to each other: deviation"});
  a.Key(UNDERSTUDY_NVP(i.accel_bias),
        {"m/s²", kForce, "Bias of the accelerometer at the start: deviation of each axis"});
  a.Key(
      UNDERSTUDY_NVP(i.accel_walk),
      {"m/s²/√s", kForce, "Random walk of the accelerometer's bias: its deviation after a second"});
  a.Key(UNDERSTUDY_NVP(i.accel_scale),
        {"", kShare, "Error of the accelerometer's scale: deviation of each axis, as a share"});
  a.Key(UNDERSTUDY_NVP(i.accel_misalignment),
        {"rad", kTurn, "How far each axis of the accelerometer leans to each other: deviation"});
  a.Key(UNDERSTUDY_NVP(i.saturate),
        {"Whether readings end at 32767 steps of the unit's lattices, as 16-bit numbers do"});
  a.Key(UNDERSTUDY_NVP(i.bandwidth),
        {"Hz", {0, 10000}, "The unit's own low pass, of first order; 0 is none"});
  a.Key(UNDERSTUDY_NVP(i.latency),
        {"s", {0, 0.1}, "How late its readings are, rounded to physics steps"});
  a.Choice(UNDERSTUDY_NVP(i.attitude),
           {"Where quaternion and rpy come from: the truth, or a filter over the unit's readings"},
           {"truth", "filter"});
  a.Key(UNDERSTUDY_NVP(i.attitude_gain),
        {"1/s", kGain, "How fast that filter turns to the vertical of the accelerometer"});
  a.Key(UNDERSTUDY_NVP(i.attitude_trim),
        {"1/s²", kGain, "How fast it learns the gyroscope's bias from that"});
  a.Key(UNDERSTUDY_NVP(i.warm_up),
        {"s",
         {0, 1e6},
         "Time constant from the air's temperature to robot.imu.temperature_c; 0 is warm at the "
         "start"});
}

void DescribeEncoderErrors(Archive& a, sensors::EncoderErrors& e) {
  a.Key(UNDERSTUDY_NVP(e.zero),
        {"rad",
         {0, 1},
         "Error of the encoders' zeros, which drives and messages share: deviation of each"});
}

void DescribeFootErrors(Archive& a, sensors::FootErrors& f) {
  a.Key(UNDERSTUDY_NVP(f.offset),
        {"N", {0, 1000}, "What a foot's sensor reads without a force: deviation of each"});
  a.Key(UNDERSTUDY_NVP(f.walk),
        {"N/√s", {0, 1000}, "Random walk of that: its deviation after a second"});
  a.Key(UNDERSTUDY_NVP(f.scale), {"", kShare, "Error of its scale: deviation of each, as a share"});
  a.Key(UNDERSTUDY_NVP(f.cross_talk),
        {"", kShare, "Share of each other foot's force that it reads: deviation"});
}

void DescribeThermometerErrors(Archive& a, sensors::ThermometerErrors& t) {
  a.Key(UNDERSTUDY_NVP(t.time_constant),
        {"s", {0, 3600}, "Inertia of the motors' thermometers; 0 is none"});
  a.Key(UNDERSTUDY_NVP(t.offset_c), {"°C", {0, 50}, "How far off they are: deviation of each"});
}

void DescribeOdometerErrors(Archive& a, sensors::OdometerErrors& o) {
  a.Key(UNDERSTUDY_NVP(o.scale),
        {"", kShare, "Error of the way by the legs: deviation ahead and to the left, as a share"});
  a.Key(UNDERSTUDY_NVP(o.walk),
        {"m/√s", {0, 10}, "Random walk of the position: its deviation after a second"});
  a.Choice(UNDERSTUDY_NVP(o.legs),
           {"Where rt/utlidar/robot_odom comes from: the truth, or the motion service's estimate"},
           {"truth", "estimate"});
  a.Key(UNDERSTUDY_NVP(o.shortfall),
        {"", kShare, "Share of the way that it misses by the estimate"});
  a.Key(UNDERSTUDY_NVP(o.turn),
        {"", kShare, "Share of each turn that its heading is off by, by the estimate"});
}

}  // namespace

void DescribeSensors(Archive& a, sensors::SensorConfig& c) {
  a.Key(UNDERSTUDY_NVP(c.quantise), {"Round readings to the lattices of the real sensors"});
  a.Key(UNDERSTUDY_NVP(c.noise), {"Add the white noise of robot.imu and robot.encoder_noise"});
  a.Key(UNDERSTUDY_NVP(c.noise_gain), {"", kGain, "Times that noise"});
  a.Key(UNDERSTUDY_NVP(c.seed),
        {"", {0, kMaxInt}, "Seed of noise and random walks, and of all that is drawn for a robot"});
  a.Section(UNDERSTUDY_NVP(c.imu), {"Errors of inertial units"}, DescribeImuErrors);
  a.Section(UNDERSTUDY_NVP(c.encoder), {"Errors of encoders"}, DescribeEncoderErrors);
  a.Section(UNDERSTUDY_NVP(c.foot), {"Errors of the feet's sensors"}, DescribeFootErrors);
  a.Section(UNDERSTUDY_NVP(c.thermometer), {"Errors of the motors' thermometers"},
            DescribeThermometerErrors);
  a.Section(UNDERSTUDY_NVP(c.odometer),
            {"Errors of the odometry in messages where no motion service estimates"},
            DescribeOdometerErrors);
}

}  // namespace understudy::config
