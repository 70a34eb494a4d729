// Checks the descriptions of the robots in config/robots.
#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

#include <nlohmann/json.hpp>

#include "config_fixture.h"
#include "robot/battery.h"
#include "robot/motor.h"

namespace understudy::config {
namespace {

Config Robot(const std::string& name) {
  return LoadConfig({.robot = name}, std::filesystem::path(UNDERSTUDY_SOURCE_DIR));
}

TEST(RobotsTest, AllLoadUnderTheirOwnNames) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    EXPECT_EQ(Robot(name).robots[0].spec.name, name);
    EXPECT_FALSE(Robot(name).robots[0].spec.description.empty());
  }
}

TEST(RobotsTest, EachServiceOfPicturesHasACamera) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    const robot::RobotSpec robot = Robot(name).robots[0].spec;
    for (const std::string& api : robot.apis) {
      if (!api.ends_with("videohub")) continue;
      EXPECT_EQ(std::ranges::count(robot.cameras, api, &robot::CameraSpec::service), 1)
          << name << ": " << api;
    }
  }
}

TEST(RobotsTest, HumanoidsWithWristsHaveTheCamerasThatTheVendorsImageServerNames) {
  for (const std::string name : {"g1", "g1_23dof", "g1_29dof_dex3", "h1_2"}) {
    const robot::RobotSpec robot = Robot(name).robots[0].spec;
    const auto camera = [&](const std::string& of) {
      const auto found = std::ranges::find(robot.cameras, of, &robot::CameraSpec::name);
      return found == robot.cameras.end() ? robot::CameraSpec() : *found;
    };
    EXPECT_EQ(camera("head").body, "torso_link") << name;
    const robot::CameraSpec left = camera("left_wrist"), right = camera("right_wrist");
    EXPECT_TRUE(left.body.starts_with("left_wrist")) << name;
    EXPECT_TRUE(right.body.starts_with("right_wrist")) << name;
    EXPECT_EQ(left.width, 640) << name;
    EXPECT_EQ(left.height, 480) << name;
    // One is the other's mirror image.
    EXPECT_EQ(left.pos.y(), -right.pos.y()) << name;
    EXPECT_EQ(left.pos.x(), right.pos.x()) << name;
    EXPECT_EQ(left.pos.z(), right.pos.z()) << name;
  }
}

TEST(RobotsTest, Go2HasTwelveMotorsInTheOrderOfTheSdk) {
  const robot::RobotSpec robot = Robot("go2").robots[0].spec;
  EXPECT_EQ(robot.family, robot::WireFamily::kGo);
  ASSERT_EQ(robot.motors.size(), 12U);
  EXPECT_EQ(robot.motors[0].joint, "FR_hip_joint");
  EXPECT_EQ(robot.motors[5].joint, "FL_calf_joint");
  EXPECT_EQ(robot.motors[7].joint, "RR_thigh_joint");
  EXPECT_EQ(robot.motors[11].joint, "RL_calf_joint");
  for (std::size_t i = 0; i < 12; ++i) {
    EXPECT_EQ(robot.motors[i].slot, static_cast<int>(i));
    EXPECT_EQ(robot.motors[i].torque_limit, i % 3 == 2 ? 45.43 : 23.7);
  }
  EXPECT_EQ(robot.default_start, "standing");
}

TEST(RobotsTest, G1Has29MotorsInTheOrderOfTheSdk) {
  const robot::RobotSpec robot = Robot("g1").robots[0].spec;
  EXPECT_EQ(robot.family, robot::WireFamily::kHg);
  EXPECT_EQ(robot.mode_machine, 5);
  ASSERT_EQ(robot.motors.size(), 29U);
  EXPECT_EQ(robot.motors[3].joint, "left_knee_joint");
  EXPECT_EQ(robot.motors[11].joint, "right_ankle_roll_joint");
  EXPECT_EQ(robot.motors[12].joint, "waist_yaw_joint");
  EXPECT_EQ(robot.motors[21].joint, "left_wrist_yaw_joint");
  EXPECT_EQ(robot.motors[28].joint, "right_wrist_yaw_joint");
  EXPECT_EQ(robot.default_start, "hanging");
}

TEST(RobotsTest, TheDex3sAreHandsOfAG1WithSevenMotorsEach) {
  const robot::RobotSpec robot = Robot("g1_29dof_dex3").robots[0].spec;
  const robot::RobotSpec g1 = Robot("g1").robots[0].spec;
  EXPECT_EQ(robot.mode_machine, g1.mode_machine);
  EXPECT_EQ(robot.motors.size(), g1.motors.size());
  EXPECT_TRUE(g1.hands.empty());
  ASSERT_EQ(robot.hands.size(), 2U);
  const auto figures = nlohmann::json::parse(
      std::ifstream(std::string(UNDERSTUDY_SOURCE_DIR) + "/tests/data/figures/g1_29dof_dex3.json"));
  for (const robot::HandSpec& hand : robot.hands) {
    EXPECT_EQ(hand.topic, "dex3/" + hand.name);
    EXPECT_EQ(hand.pads.size(), 9U);
    const auto order = figures["hands"][hand.name]["motor_order"].get<std::vector<std::string>>();
    ASSERT_EQ(hand.motors.size(), order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      EXPECT_EQ(hand.motors[i].joint, order[i]);
      for (const nlohmann::json& joint : figures["joints"]) {
        if (joint["name"] != order[i]) continue;
        EXPECT_EQ(hand.motors[i].torque_limit, joint["torque_limit"].get<double>()) << order[i];
      }
    }
  }
}

TEST(RobotsTest, AG1ListsTheProgramsOfDex3HandsAlsoWithoutThem) {
  for (const char* name : {"g1", "g1_23dof", "g1_29dof_dex3"}) {
    const std::vector<robot::ServiceSpec> services = Robot(name).robots[0].spec.services;
    for (const char* program : {"dex3_service_l", "dex3_service_r"}) {
      const auto found = std::ranges::find(services, program, &robot::ServiceSpec::name);
      ASSERT_NE(found, services.end()) << name << " " << program;
      EXPECT_TRUE(found->on && !found->protect && found->version.empty()) << program;
    }
  }
}

TEST(RobotsTest, G1PairsArePitchAndRollOfOneMechanism) {
  const robot::RobotSpec robot = Robot("g1").robots[0].spec;
  ASSERT_EQ(robot.parallel.size(), 3U);
  for (const robot::ParallelSpec& pair : robot.parallel) {
    const std::string& pitch = robot.motors[static_cast<std::size_t>(pair.pitch)].joint;
    const std::string& roll = robot.motors[static_cast<std::size_t>(pair.roll)].joint;
    EXPECT_EQ(pitch.substr(0, pitch.find("_pitch")), roll.substr(0, roll.find("_roll")));
  }
}

// q = 2 pi / 32768 / G and dq = 2 pi / 256 / G, so every lattice has the ratio 128. (G1 torque
// steps of some wrists are another matter.)
TEST(RobotsTest, LatticesFollowTheMeasuredLaw) {
  for (const std::string name : {"go2", "g1"}) {
    const Config config = Robot(name);
    for (const robot::MotorSpec& motor : config.robots[0].spec.motors) {
      if (motor.q_step == 0) continue;
      EXPECT_NEAR(motor.dq_step / motor.q_step, 128, 1e-3) << motor.joint;
      const double reduction = 2 * std::acos(-1.0) / 256 / motor.dq_step;
      EXPECT_NEAR(motor.q_step * reduction * 32768, 2 * std::acos(-1.0), 1e-4) << motor.joint;
      EXPECT_LE(motor.tau_step, reduction / 256 + 1e-6) << motor.joint;
    }
  }
}

// Band of real Go2 robots: a standing one shows a sum of 90 to 135 counts.
TEST(RobotsTest, Go2FeetShowTheCountsOfAStandingRobot) {
  const robot::FootSensorSpec sensor = Robot("go2").robots[0].spec.foot_sensor;
  const double sum = 4 * sensor.offset_counts + sensor.counts_per_newton * 15.2 * 9.81;
  EXPECT_GT(sum, 90);
  EXPECT_LT(sum, 135);
}

// Three real readings: 4.084 V per cell at 93 % and 0.939 A, 3.837 V at 63 % and 3.627 A of Go2s,
// 3.66 V at 41 % and 2.1 A of a G1.
TEST(RobotsTest, PacksGiveTheMeasuredVoltages) {
  const auto cell = [](const std::string& name, double soc, double current) {
    robot::BatterySpec pack = Robot(name).robots[0].spec.battery;
    pack.start_soc = soc;
    pack.idle_a = current;
    return robot::Battery(pack).reading().voltage / pack.cells;
  };
  EXPECT_NEAR(cell("go2", 0.93, 0.939), 4.084, 0.002);
  EXPECT_NEAR(cell("go2", 0.63, 3.627), 3.837, 0.002);
  EXPECT_NEAR(cell("g1", 0.41, 2.1), 3.66, 0.01);
}

TEST(RobotsTest, EveryMotorIsOfATypeWhoseFiguresFollowFromEachOther) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    robot::RobotSpec robot = Robot(name).robots[0].spec;
    for (const robot::MotorSpec* motor : robot::AllMotors(robot)) {
      const robot::MotorTypeSpec* type = robot::FindMotorType(robot, motor->type);
      ASSERT_NE(type, nullptr) << name << " " << motor->joint;
      // Within a factor of two: that of the torque-speed line, or its knee at 0.45.
      const double knee = type->knee_speed > 0 ? type->knee_speed : 0.45 * type->no_load_speed;
      const double loss = (type->no_load_speed - knee) / type->torque_limit;
      EXPECT_NEAR(std::log2(type->watt_per_nm2 / loss), 0, 1) << type->name;
    }
  }
}

TEST(RobotsTest, EveryMotorOfABodyLosesItsTorqueWithVoltageAndHeatAndGivesNoMoreThanItsLimit) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    const robot::RobotSpec robot = Robot(name).robots[0].spec;
    const std::size_t all = robot::AllMotors(robot).size();
    const std::vector<double> still(all);
    const robot::RobotCommand most{
        .motors = std::vector<robot::MotorCommand>(all, {.enabled = true, .tau = 1e6})};
    // What each gives at rest with such a share of its rated voltage, hotter than at rest by that.
    const auto torque = [&](double volts, double heat_c) {
      const robot::MotorTypeSpec* type = robot::FindMotorType(robot, robot.motors[0].type);
      const std::vector<robot::MotorEffects> hot(all, {.heat_c = heat_c});
      robot::MotorBank bank(robot, robot::MotorBank::kHeatPeriod);
      for (int i = 0; i < 2; ++i) {
        bank.Step({.command = most,
                   .q = still,
                   .dq = still,
                   .supply = {.voltage = volts * type->rated_v},
                   .faults = hot});
      }
      return std::vector<double>(bank.torque().begin(), bank.torque().end());
    };
    const std::vector<double> full = torque(1, 0), weak = torque(0.1, 0), warm = torque(1, 80),
                              hot = torque(1, 120);
    for (std::size_t i = 0; i < robot.motors.size(); ++i) {
      SCOPED_TRACE(name + " " + robot.motors[i].joint);
      const robot::MotorTypeSpec* type = robot::FindMotorType(robot, robot.motors[i].type);
      EXPECT_GT(type->rated_v, 0);
      EXPECT_GT(type->no_load_speed, 0);
      EXPECT_LE(full[i], robot.motors[i].torque_limit);
      if (full[i] == 0) continue;  // of a pair whose motors push alike: its roll
      EXPECT_GE(full[i], 0.5 * robot.motors[i].torque_limit);
      EXPECT_LT(weak[i], 0.5 * full[i]);
      EXPECT_LT(warm[i], full[i]);
      EXPECT_GE(warm[i], 0.5 * full[i]);
      EXPECT_EQ(hot[i], 0);
    }
  }
}

// s until the first motor whose joint is named gives less torque and none, stalled at its limit.
std::array<double, 2> StallsFor(const std::string& name, const std::string& joint) {
  constexpr double kStep = 0.1;
  const robot::RobotSpec robot = Robot(name).robots[0].spec;
  const std::size_t count = robot.motors.size();
  const auto found = std::ranges::find(robot.motors, joint, &robot::MotorSpec::joint);
  const auto stalled = static_cast<std::size_t>(found - robot.motors.begin());
  robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(count)};
  command.motors.at(stalled) = {.enabled = true, .tau = 1000};
  const std::vector<double> still(count);
  robot::MotorBank bank(robot, kStep);
  std::array<double, 2> times{};
  for (int i = 1; i < 36000 && times[1] == 0; ++i) {
    bank.Step({.command = command, .q = still, .dq = still});
    if (times[0] == 0 && bank.derated(stalled)) times[0] = i * kStep;
    if (bank.tripped(stalled)) times[1] = i * kStep;
  }
  return times;
}

TEST(RobotsTest, AStalledMotorGivesLessAfterSecondsAndTripsAfterMinutesAtMost) {
  const auto [hip_warm, hip_hot] = StallsFor("go2", "FR_hip_joint");
  EXPECT_NEAR(hip_warm, 13, 3);
  EXPECT_NEAR(hip_hot, 133, 30);
  const auto [knee_warm, knee_hot] = StallsFor("g1", "left_knee_joint");
  EXPECT_NEAR(knee_warm, 9, 3);
  EXPECT_NEAR(knee_hot, 20, 6);
}

// An ankle of a G1 was seen at 89 to 91 °C after 5 to 10 minutes of one policy (A9). What its
// torque was is not recorded; 20 N·m, 10 of each motor, are assumed.
TEST(RobotsTest, AnAnkleGetsAboutAsHotAsOneWasSeenUnderAPolicy) {
  const robot::RobotSpec robot = Robot("g1").robots[0].spec;
  robot::RobotCommand command{.motors = std::vector<robot::MotorCommand>(robot.motors.size())};
  command.motors[5] = {.enabled = true, .tau = 20};
  ASSERT_EQ(robot.motors[5].joint, "left_ankle_roll_joint");
  const std::vector<double> still(robot.motors.size());
  robot::MotorBank bank(robot, 0.1);
  const auto after = [&](double seconds) {
    for (int i = 0; i < 10 * seconds; ++i) {
      bank.Step({.command = command, .q = still, .dq = still});
    }
    return bank.winding_c()[5];
  };
  EXPECT_NEAR(after(600), 79, 2);
  EXPECT_NEAR(after(3000), 94, 2);
}

// Of each robot: a pack from which its most current is asked all the time has ever less for its
// motors, and cuts off in the end; without any torque lost before, nothing would tell that it dies.
TEST(RobotsTest, ADyingPackWeakensTheMotorsBeforeItCutsOff) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    SCOPED_TRACE(name);
    const robot::RobotSpec robot = Robot(name).robots[0].spec;
    const robot::MotorSpec& motor = robot.motors[0];
    const double rated_v = robot::FindMotorType(robot, motor.type)->rated_v;
    const robot::TorqueCurve curve{motor.torque_limit, motor.knee_speed, motor.no_load_speed};
    const auto torque = [&](const robot::Battery& pack) {
      const double volts = std::min(1.0, pack.supply().voltage / rated_v);
      const double rate = curve.knee > 0 ? curve.knee : 0.5 * curve.no_load;
      return robot::AvailableTorque(curve, 1e9, rate, volts) / curve.limit;
    };
    robot::Battery pack(robot.battery);
    EXPECT_EQ(torque(pack), 1) << "full";
    const double power = 2 * robot.battery.idle_a * pack.reading().voltage;
    double weakest = 1;
    while (pack.cut_off() == robot::CutOff::kNone) {
      weakest = torque(pack);
      pack.Step(power, 1);
    }
    EXPECT_LT(weakest, 0.9);
    EXPECT_LT(pack.reading().soc, 0.1);
    EXPECT_FALSE(pack.supply().on);
  }
}

TEST(RobotsTest, AnUnknownMotorTypeNamesTheNearest) {
  EXPECT_THAT(ErrorOf([] {
                LoadConfig({.robot = "go2", .sets = {"robot.motors.0.type=Go2VH"}},
                           std::filesystem::path(UNDERSTUDY_SOURCE_DIR));
              }),
              testing::HasSubstr("robot.motors.0.type: no motor type 'Go2VH'; did you mean "
                                 "'Go2HV'?"));
}

// A type's limits are at its own output; a motor may have others.
TEST(RobotsTest, MotorsHaveTheLimitsOfTheirTypesUnlessTheyHaveTheirOwn) {
  const robot::RobotSpec geared =
      LoadConfig(
          {.robot = "go2", .sets = {"robot.motors.0.gear=2", "robot.motors.1.torque_limit=7"}},
          std::filesystem::path(UNDERSTUDY_SOURCE_DIR))
          .robots[0]
          .spec;
  EXPECT_EQ(geared.motors[0].torque_limit, 2 * 23.7);
  EXPECT_EQ(geared.motors[0].knee_speed, 13.5 / 2);
  EXPECT_EQ(geared.motors[0].no_load_speed, 30.1 / 2);
  EXPECT_EQ(geared.motors[1].torque_limit, 7);
  EXPECT_EQ(geared.motors[1].knee_speed, 13.5);
  EXPECT_EQ(geared.motors[3].torque_limit, 23.7);
}

TEST(RobotsTest, NominalLimitsAreThoseOfTheJointAtAFullBattery) {
  for (const std::string& name : RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    const robot::RobotSpec robot = Robot(name).robots[0].spec;
    const robot::Battery pack(robot.battery);
    for (const robot::MotorSpec& motor : robot.motors) {
      const robot::MotorTypeSpec* type = robot::FindMotorType(robot, motor.type);
      EXPECT_GE(pack.supply().voltage, type->rated_v) << name << " " << motor.joint;
    }
  }
}

}  // namespace
}  // namespace understudy::config
