#include "config/validate_robot.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <set>
#include <string>
#include <vector>

#include "authority/chord.h"
#include "base/nearest_word.h"
#include "config/archive.h"
#include "config/keys.h"
#include "robot/firmware.h"
#include "services/api_names.h"

namespace understudy::config {
namespace {

// Motors that fit into one message: unitree_go LowCmd_.motor_cmd[20], unitree_hg's [35].
constexpr int kGoSlots = 20;
constexpr int kHgSlots = 35;
constexpr std::size_t kHandMotors = 16;  // ids of the mode byte of a hand

void CheckCurve(double knee_speed, double no_load_speed, const std::string& key,
                const Checker& checker) {
  checker.Check(knee_speed == 0 || knee_speed < no_load_speed, key + "knee_speed",
                "expected less than no_load_speed " + NumberText(no_load_speed) + " rad/s, got " +
                    NumberText(knee_speed));
}

void CheckMotorTypes(const std::vector<robot::MotorTypeSpec>& types, const Checker& checker) {
  std::set<std::string> names;
  for (std::size_t i = 0; i < types.size(); ++i) {
    const robot::MotorTypeSpec& type = types[i];
    const std::string key = "robot.motor_types." + std::to_string(i) + ".";
    checker.Check(!type.name.empty(), key + "name", "expected a name");
    checker.Check(names.insert(type.name).second, key + "name",
                  "there is a '" + type.name + "' already");
    CheckCurve(type.knee_speed, type.no_load_speed, key, checker);
    checker.Check((type.winding_c_per_w > 0) == (type.casing_c_per_w > 0), key + "casing_c_per_w",
                  "expected winding_c_per_w and this both 0, or neither");
  }
}

// `list` is the key of the motors, `joints` the joints that already have a motor.
void CheckMotors(const std::vector<robot::MotorSpec>& motors,
                 const std::vector<robot::MotorTypeSpec>& types, const std::string& list,
                 std::set<std::string>* joints, const Checker& checker) {
  std::vector<std::string> names;
  for (const robot::MotorTypeSpec& type : types) names.push_back(type.name);
  for (std::size_t i = 0; i < motors.size(); ++i) {
    const robot::MotorSpec& m = motors[i];
    const std::string key = list + "." + std::to_string(i) + ".";
    checker.Check(!m.joint.empty(), key + "joint", "expected the name of a joint");
    checker.Check(joints->insert(m.joint).second, key + "joint",
                  "'" + m.joint + "' has a motor already");
    const bool known = m.type.empty() || std::ranges::find(names, m.type) != names.end();
    checker.Check(known, key + "type",
                  known           ? ""
                  : names.empty() ? "no motor type '" + m.type +
                                        "', nor any other: config/motors.yaml is missing"
                                  : "no motor type '" + m.type + "'" + DidYouMean(m.type, names));
    checker.Check(m.torque_limit > 0, key + "torque_limit", "expected more than 0 N·m");
    CheckCurve(m.knee_speed, m.no_load_speed, key, checker);
  }
}

void CheckSlots(const robot::RobotSpec& robot, const Checker& checker) {
  const int slots = robot.family == robot::WireFamily::kGo ? kGoSlots : kHgSlots;
  int last = -1;
  checker.Check(!robot.motors.empty(), "robot.motors", "expected at least one motor");
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const int slot = robot.motors[i].slot;
    const std::string key = "robot.motors." + std::to_string(i) + ".slot";
    checker.Check(slot >= 0 && slot < slots, key,
                  "expected 0 to " + std::to_string(slots - 1) + " for this family, got " +
                      std::to_string(slot));
    checker.Check(slot > last, key,
                  "expected more than " + std::to_string(last) +
                      ", as slots ascend and no two are alike, got " + std::to_string(slot));
    last = slot;
  }
}

// Whether it may be part of a DDS topic's name: words between slashes.
bool IsTopic(const std::string& topic) {
  const auto fits = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == '/';
  };
  return !topic.empty() && topic.front() != '/' && topic.back() != '/' &&
         topic.find("//") == std::string::npos && std::all_of(topic.begin(), topic.end(), fits);
}

void CheckHand(const robot::HandSpec& hand, const std::vector<robot::MotorTypeSpec>& types,
               const std::string& key, std::set<std::string>* joints, const Checker& checker) {
  checker.Check(!hand.name.empty(), key + "name", "expected a name");
  checker.Check(IsTopic(hand.topic), key + "topic",
                "expected words of letters, digits and _ between slashes, as in dex3/left, got '" +
                    hand.topic + "'");
  checker.Check(!hand.motors.empty() && hand.motors.size() <= kHandMotors, key + "motors",
                "expected 1 to " + std::to_string(kHandMotors) + ", got " +
                    std::to_string(hand.motors.size()));
  CheckMotors(hand.motors, types, key + "motors", joints, checker);
}

void CheckHands(const robot::RobotSpec& robot, std::set<std::string>* joints,
                const Checker& checker) {
  checker.Check(robot.hands.empty() || robot.family == robot::WireFamily::kHg, "robot.hands",
                "the go family has no messages for them");
  checker.Check(robot.hands.size() <= robot::kMostHands, "robot.hands",
                "expected at most " + std::to_string(robot::kMostHands) + ", got " +
                    std::to_string(robot.hands.size()));
  std::set<std::string> topics;
  for (std::size_t i = 0; i < robot.hands.size(); ++i) {
    const robot::HandSpec& hand = robot.hands[i];
    const std::string key = "robot.hands." + std::to_string(i) + ".";
    CheckHand(hand, robot.motor_types, key, joints, checker);
    checker.Check(topics.insert(hand.topic).second, key + "topic",
                  "another hand has '" + hand.topic + "' already");
  }
}

void CheckClamps(const robot::RobotSpec& robot, const Checker& checker) {
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const std::array<double, 2>& clamp = robot.motors[i].q_clamp;
    checker.Check(clamp[0] <= clamp[1], "robot.motors." + std::to_string(i) + ".q_clamp",
                  "expected least before most");
  }
}

void CheckParallel(const robot::RobotSpec& robot, const Checker& checker) {
  const int motors = static_cast<int>(robot.motors.size());
  std::set<int> taken;
  for (std::size_t i = 0; i < robot.parallel.size(); ++i) {
    const std::string pair = "robot.parallel." + std::to_string(i);
    const auto check = [&](int index, const std::string& key) {
      checker.Check(index >= 0 && index < motors, key,
                    "expected 0 to " + std::to_string(motors - 1) + ", as there are " +
                        std::to_string(motors) + " motors, got " + std::to_string(index));
      checker.Check(taken.insert(index).second, key,
                    "motor " + std::to_string(index) + " is in a pair already");
    };
    check(robot.parallel[i].pitch, pair + ".pitch");
    check(robot.parallel[i].roll, pair + ".roll");
    checker.Check(robot.parallel[i].roll_ratio > 0, pair + ".roll_ratio", "expected more than 0");
  }
}

void CheckDynamics(const robot::RobotSpec& robot, const Checker& checker) {
  const robot::DynamicsSpec& dynamics = robot.dynamics;
  if (dynamics.use != robot::DynamicsSource::kFitted) return;
  checker.Check(!dynamics.fitted.empty(), "robot.dynamics.use",
                "robot '" + robot.name + "' has no fitted figures; choose catalogue");
  std::set<int> taken;
  for (std::size_t i = 0; i < dynamics.fitted.size(); ++i) {
    const std::string key = "robot.dynamics.fitted." + std::to_string(i) + ".slots";
    const std::vector<int>& slots = dynamics.fitted[i].slots;
    // Some slots may have no motor: a variant of the robot may have fewer motors.
    checker.Check(std::any_of(robot.motors.begin(), robot.motors.end(),
                              [&slots](const robot::MotorSpec& motor) {
                                return std::find(slots.begin(), slots.end(), motor.slot) !=
                                       slots.end();
                              }),
                  key, "expected slots of motors; none of these has one");
    for (const int slot : slots) {
      checker.Check(taken.insert(slot).second, key,
                    "slot " + std::to_string(slot) + " has figures already");
    }
  }
}

void CheckPose(const robot::PoseSpec& pose, const std::string& name, std::size_t motors,
               const Checker& checker) {
  checker.Check(pose.q.size() == motors, "robot." + name + ".q",
                "expected one angle per motor, " + std::to_string(motors) + ", got " +
                    std::to_string(pose.q.size()));
  double norm = 0;
  for (const double x : pose.quat) norm += x * x;
  checker.Check(std::abs(norm - 1) < 1e-3, "robot." + name + ".quat",
                "expected four numbers w, x, y, z of length 1");
}

void CheckHumanoid(const robot::RobotSpec& robot, const Checker& checker) {
  const robot::HumanoidMotionSpec& humanoid = robot.motion.humanoid;
  const std::string section = "robot.motion.humanoid.";
  const auto check_pose = [&](const std::vector<double>& q, bool needed, const std::string& key,
                              const std::string& state) {
    checker.Check(q.size() == robot.motors.size() || (q.empty() && !needed), section + key,
                  "expected one angle per motor, " + std::to_string(robot.motors.size()) +
                      (needed ? ", as there is a " + state : "") + ", got " +
                      std::to_string(q.size()));
  };
  check_pose(humanoid.squat_q, humanoid.squat >= 0 || humanoid.balanced_squat >= 0, "squat_q",
             "squat");
  check_pose(humanoid.sit_q, humanoid.sit >= 0, "sit_q", "sit");
}

// Checks that a robot has the figures that the motion service of its kind needs.
void CheckKind(const robot::RobotSpec& robot, const Checker& checker) {
  const std::string otherwise = ", or robot.kind other for a motion service that only damps";
  checker.Check(robot.kind != robot::RobotKind::kHumanoid || robot.motion.humanoid.lock_stand >= 0,
                "robot.motion.humanoid.lock_stand", "a humanoid needs this state" + otherwise);
  checker.Check(!robot::IsQuadruped(robot.kind) || robot.motion.quadruped.stand_height > 0,
                "robot.motion.quadruped.stand_height", "a quadruped needs this height" + otherwise);
  constexpr std::size_t kWheeledMotors = 16;  // three a leg, then the wheels
  checker.Check(robot.kind != robot::RobotKind::kWheeled || robot.motors.size() == kWheeledMotors,
                "robot.motors",
                "a wheeled robot has 16, got " + std::to_string(robot.motors.size()));
}

void CheckApis(const robot::RobotSpec& robot, const Checker& checker) {
  const std::vector<std::string> names(services::kApiNames.begin(), services::kApiNames.end());
  for (std::size_t i = 0; i < robot.apis.size(); ++i) {
    checker.Check(std::find(names.begin(), names.end(), robot.apis[i]) != names.end(),
                  "robot.apis." + std::to_string(i),
                  "no api '" + robot.apis[i] + "'" + DidYouMean(robot.apis[i], names));
  }
}

// Checks the differences from the model's bodies: vectors are complete or empty.
void CheckBodies(const robot::RobotSpec& robot, const Checker& checker) {
  for (std::size_t i = 0; i < robot.bodies.size(); ++i) {
    const robot::BodySpec& body = robot.bodies[i];
    const std::string key = "robot.bodies." + std::to_string(i) + ".";
    const auto check = [&](const std::vector<double>& values, std::size_t length,
                           const std::string& name) {
      checker.Check(values.empty() || values.size() == length, key + name,
                    "expected " + std::to_string(length) + " numbers or none, got " +
                        std::to_string(values.size()));
    };
    checker.Check(!body.name.empty(), key + "name", "expected the name of a body");
    check(body.pos, 3, "pos");
    check(body.com, 3, "com");
    check(body.inertia, 6, "inertia");
  }
  for (std::size_t i = 0; i < robot.sites.size(); ++i) {
    checker.Check(!robot.sites[i].name.empty(), "robot.sites." + std::to_string(i) + ".name",
                  "expected the name of a site");
  }
}

void CheckFirmware(const robot::RobotSpec& robot, const Checker& checker) {
  const auto check = [&](const std::string& version, const std::string& key) {
    checker.Check(version.empty() || robot::IsFirmware(version), key,
                  "expected numbers between dots, as in 1.1.6, got '" + version + "'");
  };
  check(robot.firmware, "robot.firmware");
  check(robot.state_id_since, "robot.state_id_since");
  for (std::size_t i = 0; i < robot.services.size(); ++i) {
    const robot::ServiceSpec& service = robot.services[i];
    const std::string key = "robot.services." + std::to_string(i) + ".";
    checker.Check(!service.name.empty(), key + "name", "expected a name");
    check(service.since, key + "since");
    check(service.before, key + "before");
  }
}

void CheckBuses(const robot::RobotSpec& robot, const Checker& checker) {
  std::set<std::string> names;
  std::set<int> taken;
  for (std::size_t i = 0; i < robot.buses.size(); ++i) {
    const robot::BusSpec& bus = robot.buses[i];
    const std::string key = "robot.buses." + std::to_string(i) + ".";
    checker.Check(!bus.name.empty() && names.insert(bus.name).second, key + "name",
                  "expected a name of its own, got '" + bus.name + "'");
    for (const int slot : bus.slots) {
      checker.Check(taken.insert(slot).second, key + "slots",
                    "slot " + std::to_string(slot) + " is on a bus already");
    }
    checker.Check(bus.delay[0] <= bus.delay[1], key + "delay",
                  "expected least before most, got " + NumberText(bus.delay[0]) + " before " +
                      NumberText(bus.delay[1]));
  }
}

void CheckFans(const robot::RobotSpec& robot, const Checker& checker) {
  std::set<std::string> names;
  std::set<int> taken;
  for (std::size_t i = 0; i < robot.fans.size(); ++i) {
    const robot::FanSpec& fan = robot.fans[i];
    const std::string key = "robot.fans." + std::to_string(i) + ".";
    checker.Check(!fan.name.empty() && names.insert(fan.name).second, key + "name",
                  "expected a name of its own, got '" + fan.name + "'");
    checker.Check(taken.insert(fan.place).second, key + "place",
                  "place " + std::to_string(fan.place) + " has a fan already");
  }
}

void CheckArmSdk(const robot::RobotSpec& robot, const Checker& checker) {
  const int slots = robot.family == robot::WireFamily::kGo ? kGoSlots : kHgSlots;
  const robot::ArmSdkSpec& arms = robot.arm_sdk;
  for (const int slot : arms.slots) {
    const bool has = std::any_of(robot.motors.begin(), robot.motors.end(),
                                 [&](const robot::MotorSpec& motor) { return motor.slot == slot; });
    checker.Check(has, "robot.arm_sdk.slots", "no motor is in slot " + std::to_string(slot));
  }
  checker.Check(arms.weight_slot < slots, "robot.arm_sdk.weight_slot",
                "expected 0 to " + std::to_string(slots - 1) + " for this family, got " +
                    std::to_string(arms.weight_slot));
}

void CheckRemote(const robot::RobotSpec& robot, const Checker& checker) {
  for (std::size_t i = 0; i < robot.remote.chords.size(); ++i) {
    const std::string key = "robot.remote.chords." + std::to_string(i);
    authority::MakeChord(robot.remote.chords[i], checker.Where(key + ".keys") + key);
  }
}

void CheckBattery(const robot::BatterySpec& battery, const Checker& checker) {
  for (std::size_t i = 1; i < battery.cell_v.size(); ++i) {
    checker.Check(battery.cell_v[i] > battery.cell_v[i - 1], "robot.battery.cell_v",
                  "expected rising voltages, got " + NumberText(battery.cell_v[i]) + " after " +
                      NumberText(battery.cell_v[i - 1]));
  }
  checker.Check(battery.cells > 0, "robot.battery.cells", "expected at least one cell");
  checker.Check(battery.capacity_ah > 0, "robot.battery.capacity_ah", "expected more than 0 A·h");
  checker.Check(battery.most_a == 0 || battery.most_a > battery.idle_a, "robot.battery.most_a",
                "expected more than idle_a " + NumberText(battery.idle_a) + " A, got " +
                    NumberText(battery.most_a));
  checker.Check(battery.cutoff_v < battery.cell_v[1], "robot.battery.cutoff_v",
                "expected less than a cell at a tenth of its charge has, " +
                    NumberText(battery.cell_v[1]) + " V, got " + NumberText(battery.cutoff_v));
}

}  // namespace

void CheckStartPose(const std::string& pose, const std::string& key, const Checker& checker) {
  const std::vector<std::string>& poses = StartPoses();
  checker.Check(std::find(poses.begin(), poses.end(), pose) != poses.end(), key,
                "no pose '" + pose + "'" + DidYouMean(pose, poses));
}

void ValidateRobot(const robot::RobotSpec& robot, const Checker& checker) {
  checker.Check(!robot.name.empty(), "robot.name", "expected a name");
  checker.Check(!robot.model.empty(), "robot.model", "expected a model file");
  checker.Check(!robot.base_body.empty(), "robot.base_body", "expected the name of a body");
  checker.Check(!robot.imu.site.empty(), "robot.imu.site", "expected the name of a site");
  checker.Check(!robot.crane_body.empty(), "robot.crane_body", "expected the name of a body");
  checker.Check(robot.mode_machine >= 0 && robot.mode_machine <= 255, "robot.mode_machine",
                "expected 0 to 255");
  std::set<std::string> joints;
  CheckSlots(robot, checker);
  CheckMotorTypes(robot.motor_types, checker);
  CheckMotors(robot.motors, robot.motor_types, "robot.motors", &joints, checker);
  CheckHands(robot, &joints, checker);
  CheckParallel(robot, checker);
  CheckDynamics(robot, checker);
  CheckClamps(robot, checker);
  CheckBodies(robot, checker);
  CheckPose(robot.lying, "lying", robot.motors.size(), checker);
  CheckPose(robot.standing, "standing", robot.motors.size(), checker);
  CheckPose(robot.hanging, "hanging", robot.motors.size(), checker);
  CheckStartPose(robot.default_start, "robot.default_start", checker);
  CheckKind(robot, checker);
  CheckApis(robot, checker);
  CheckHumanoid(robot, checker);
  const std::array<double, 2>& height_range = robot.motion.quadruped.height_range;
  checker.Check(height_range[0] <= height_range[1], "robot.motion.quadruped.height_range",
                "expected least before most");
  CheckFirmware(robot, checker);
  CheckArmSdk(robot, checker);
  CheckBuses(robot, checker);
  CheckFans(robot, checker);
  CheckRemote(robot, checker);
  CheckBattery(robot.battery, checker);
}

}  // namespace understudy::config
