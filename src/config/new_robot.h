// Makes the description of a robot from its URDF and a robot that it is like: for `understudy new`.
#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "mjcf/urdf_reader.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// A motor of the robot that it is like, and the joint that it drives.
struct MotorMatch {
  std::string motor;  // its joint there: the motor's name
  int slot = 0;
  std::string joint;              // "" if none was found
  std::vector<std::string> near;  // then names of joints that are left, the nearest first
};

// Finds a joint for each motor, in motor order: one of the same name; else the only one that is the
// same but for case, underlines, "joint" and usual words for one part (front right, FR; HAA, hip).
std::vector<MotorMatch> MatchMotors(const robot::RobotSpec& like,
                                    const std::vector<mjcf::UrdfReadJoint>& joints);

struct NewRobot {
  std::string name;
  std::string like;       // as typed
  std::string urdf;       // as typed
  mjcf::UrdfRobot robot;  // its model has the sites
  std::vector<MotorMatch> motors;
  bool two_units = false;    // inertial ones
  bool keeps_hands = false;  // it can bear the hands of the other
};

// Adds sites for the inertial units, named as in `like`, to the model. The main unit is in the body
// of the first link with "imu" in its name that is fixed to the base, of the first such link
// elsewhere if there is none, else at the origin of the base. The second unit, if `like` has one,
// is in the first such link elsewhere. Returns the two bodies, "" for no second unit.
std::array<std::string, 2> AddImuSites(const robot::RobotSpec& like, mjcf::UrdfRobot* robot);

// Returns whether the URDF has all links on which hands of `like` sit; their models are `hands`.
// Throws ModelError if one cannot be read.
bool HasWrists(const mjcf::UrdfRobot& robot, const std::vector<std::filesystem::path>& hands);

// Returns the robot's YAML, commented. `model` is the compiled one; in it the soles of feet and the
// heights of start poses are looked up. `revisions` are those of `like`, which it loses.
std::string NewRobotYaml(const NewRobot& robot, const robot::RobotSpec& like, const mjModel& model,
                         const std::vector<std::string>& revisions);

// Returns a first scenario: the robot starts and stays upright. `file` is the robot's YAML.
std::string NewScenarioYaml(const NewRobot& robot, const robot::RobotSpec& like,
                            const mjModel& model, const std::string& file);

}  // namespace understudy::config
