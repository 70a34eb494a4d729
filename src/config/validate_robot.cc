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
#include "config/keys.h"
#include "config/validate_motors.h"
#include "motion/controllers.h"
#include "robot/firmware.h"
#include "robot/lens.h"
#include "schema/archive.h"
#include "services/api_names.h"

namespace understudy::config {
namespace {

using schema::NumberText;

constexpr double kWidestView = 5.67;  // tangent of 80°

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

// The policy's own errors name its files.
void CheckControllers(const robot::RobotSpec& robot, const Checker& checker) {
  const std::vector<std::string> names = motion::ControllerNames(robot.kind);
  for (std::size_t i = 0; i < robot.services.size(); ++i) {
    const robot::ServiceSpec& service = robot.services[i];
    const std::string& name = service.controller;
    checker.Check(std::ranges::count(names, name) > 0,
                  "robot.services." + std::to_string(i) + ".controller",
                  "no controller '" + name + "' for a robot of its kind" + DidYouMean(name, names));
    const motion::ControllerRow* row = motion::FindController(name);
    if (row != nullptr && row->check != nullptr) row->check(robot, service);
  }
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

// The lens is to show each direction once: corners and middles of edges tell.
bool IsSharp(const robot::CameraSpec& camera) {
  const double width = camera.width, height = camera.height;
  for (const double u : {0.0, width / 2, width}) {
    for (const double v : {0.0, height / 2, height}) {
      const Eigen::Vector2d direction = robot::DirectionOf(camera, {u, v});
      const Eigen::Vector2d off = robot::PixelOf(camera, direction) - Eigen::Vector2d(u, v);
      if (!(off.norm() < 0.1) || !(direction.norm() < kWidestView)) return false;
    }
  }
  return true;
}

void CheckCameras(const robot::RobotSpec& robot, const Checker& checker) {
  const std::vector<std::string> services =
      services::ServiceNames({services::kApiNames.begin(), services::kApiNames.end()});
  std::set<std::string> names, given;
  for (std::size_t i = 0; i < robot.cameras.size(); ++i) {
    const robot::CameraSpec& camera = robot.cameras[i];
    const std::string key = "robot.cameras." + std::to_string(i) + ".";
    checker.Check(!camera.name.empty(), key + "name", "expected a name");
    checker.Check(names.insert(camera.name).second, key + "name",
                  "there is a '" + camera.name + "' already");
    const std::string& service = camera.service;
    checker.Check(service.empty() || std::ranges::find(services, service) != services.end(),
                  key + "service", "no service '" + service + "'" + NearestHint(service, services));
    checker.Check(service.empty() || given.insert(service).second, key + "service",
                  "'" + service + "' has a camera already");
    checker.Check(IsSharp(camera), key + "distortion",
                  "expected a lens that shows each direction once, within 80° of its axis");
    checker.Check(camera.depth[0] <= camera.depth[1], key + "depth",
                  "expected the nearest before the farthest");
    if (!robot::IsBinocular(camera)) continue;
    checker.Check(names.insert(robot::RightEyeName(camera)).second, key + "name",
                  "there is a '" + robot::RightEyeName(camera) + "', as its right eye is called");
    checker.Check(!robot::HasDepth(camera), key + "depth",
                  "expected 0, 0 of a camera with two eyes (baseline)");
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
  const int slots = SlotsOf(robot);
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
  ValidateMotors(robot, checker);
  CheckDynamics(robot, checker);
  CheckBodies(robot, checker);
  CheckPose(robot.lying, "lying", robot.motors.size(), checker);
  CheckPose(robot.standing, "standing", robot.motors.size(), checker);
  CheckPose(robot.hanging, "hanging", robot.motors.size(), checker);
  CheckStartPose(robot.default_start, "robot.default_start", checker);
  CheckKind(robot, checker);
  CheckApis(robot, checker);
  CheckCameras(robot, checker);
  CheckHumanoid(robot, checker);
  CheckControllers(robot, checker);
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
