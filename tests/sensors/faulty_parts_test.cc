// What sensors tell of parts that fail, and how they go on with other errors.
#include <vector>

#include "tests/sensors/sensors_fixture.h"

namespace understudy::sensors {
namespace {

TEST_F(SensorsTest, KeepTheForceOfAFootThatIsStuck) {
  Sensors sensors = Make(kTruth);
  robot::RobotState state = Sample(&sensors);
  state.foot_force[1] = 77;
  faults_.feet[1].stuck = true;
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.foot_force[1], 77);
  faults_.feet[1].stuck = false;
  SampleInto(&sensors, &state);
  EXPECT_NE(state.foot_force[1], 77);
}

TEST_F(SensorsTest, LeaveTheReadingsOfAMotorWhosePacketIsLostAndCountIt) {
  Sensors sensors = Make(kTruth);
  robot::RobotState state = Sample(&sensors);
  state.motors[1].q = 7;
  faults_.motors[1].unheard = true;
  SampleInto(&sensors, &state);
  EXPECT_EQ(state.motors[1].q, 7);
  EXPECT_EQ(state.motors[1].lost, 1U);
  EXPECT_FALSE(state.motors[1].silent);
}

TEST_F(SensorsTest, TellWhichMotorsHaveTimedOut) {
  command_.motors[3].timed_out = true;
  const robot::RobotState state = Sample(kTruth);
  EXPECT_TRUE(state.motors[3].timed_out);
  EXPECT_FALSE(state.motors[2].timed_out);
}

TEST_F(SensorsTest, TellMotorsThatAreNearlyAndThatAreTooHot) {
  std::vector<robot::MotorEffects> hot(6);
  hot[1].heat_c = spec_.thermal.derate_c - 20;
  hot[2].heat_c = spec_.thermal.trip_c;
  const std::vector<double> still(6);
  while (!motors_.tripped(2)) {
    motors_.Step({.command = command_, .q = still, .dq = still, .faults = hot});
  }
  const robot::RobotState state = Sample(kTruth);
  EXPECT_FALSE(state.motors[0].warm);
  EXPECT_TRUE(state.motors[1].warm);
  EXPECT_FALSE(state.motors[1].overheated);
  EXPECT_TRUE(state.motors[2].overheated);
}

TEST_F(SensorsTest, TellWhatTheMainboardTells) {
  const std::vector<robot::FanEffects> none;
  board_.Step(0.001, none, {.heat_c = 30});
  const robot::RobotState state = Sample(kTruth);
  EXPECT_EQ(state.board.centre_c, board_.reading().centre_c);
  EXPECT_GT(state.board.centre_c, 30);
}

TEST_F(SensorsTest, TellOdometryByTheHeadingThatTheUnitTells) {
  const robot::RobotState right = Sample(kTruth);
  EXPECT_EQ(right.odometry.p_WB, right.base.p_WB);
  EXPECT_EQ(right.odometry.v_WB_W, right.base.v_WB_W);
  Sensors sensors = Make(kTruth);
  faults_.imus[0].turn = 0.5;
  const robot::RobotState turned = Sample(&sensors);
  const Eigen::AngleAxisd off(0.5, Eigen::Vector3d::UnitZ());
  EXPECT_GT(turned.base.v_WB_W.head<2>().norm(), 1e-3);
  EXPECT_TRUE((off * turned.base.v_WB_W).isApprox(turned.odometry.v_WB_W, 1e-9));
  EXPECT_NE(turned.odometry.p_WB, turned.base.p_WB);
}

// Everything that is drawn: of both units, feet, odometer and thermometers.
TEST_F(SensorsTest, GoOnWithOtherErrorsAsIfTheyHadHadThemFromTheStart) {
  SensorConfig config = kLattice;
  config.imu = {.gyro_bias = 0.1, .accel_bias = 0.5, .accel_scale = 0.05};
  config.foot = {.offset = 5, .scale = 0.1};
  config.odometer.scale = 0.1;
  config.thermometer.offset_c = 3;
  Sensors sensors = Make(kTruth);
  sensors.Apply(config);
  const robot::RobotState told = Sample(&sensors), wanted = Sample(config);
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_EQ(told.motors[i].q, wanted.motors[i].q);
    EXPECT_EQ(told.motors[i].casing_c, wanted.motors[i].casing_c);
    EXPECT_EQ(told.motors[i].winding_c, wanted.motors[i].winding_c);
  }
  EXPECT_EQ(told.imu.w_WI_I, wanted.imu.w_WI_I);
  EXPECT_EQ(told.secondary_imu.f_WI_I, wanted.secondary_imu.f_WI_I);
  EXPECT_EQ(told.foot_force, wanted.foot_force);
  EXPECT_EQ(told.odometry.v_WB_W, wanted.odometry.v_WB_W);
  EXPECT_NE(told.odometry.v_WB_W, told.base.v_WB_W);
}

TEST_F(SensorsTest, MultiplyTheNoiseOfTheBodyByTheirGain) {
  const auto off = [this](double gain) {
    const robot::RobotState state = Sample({.quantise = false, .noise_gain = gain});
    return state.motors[1].q - world_.robot().q()[1];
  };
  EXPECT_NE(off(1), 0);
  EXPECT_NEAR(off(3), 3 * off(1), 1e-12);
}

TEST_F(SensorsTest, BeginThermometersAnewAtWhatThereIs) {
  SensorConfig config = kTruth;
  config.thermometer.time_constant = 1000;
  Sensors sensors(config, spec_, 0.001);
  sensors.Restart(instant());
  const robot::RobotState state = Sample(&sensors);
  EXPECT_NEAR(state.motors[0].casing_c, motors_.casing_c()[0], 1e-3);
  EXPECT_NEAR(state.motors[0].winding_c, motors_.winding_c()[0], 1e-3);
}

}  // namespace
}  // namespace understudy::sensors
