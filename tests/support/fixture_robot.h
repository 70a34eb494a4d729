// The robot of tests/data/fixture_robot.xml: four legs of one joint each and a neck of two.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "config/config.h"
#include "physics/mujoco_world.h"
#include "robot/robot_spec.h"

namespace understudy::test {

// Motor order FR FL RR RL neck_pitch neck_roll; slots 0 1 3 4 6 7. Torque limit 50 N·m at any
// speed, lattices of powers of two, no noise, the neck a parallel pair. It stands on straight legs
// with the base at 0.3 m, lies on its trunk, hangs in its standing pose at 1 m.
robot::RobotSpec FixtureRobot();

// The same with a hand "neck" in place of the neck, its motors the other way round: roll, pitch.
// They give 5 N·m; locked they brake with 1 N·m·s/rad, watched they time out after 0.1 s.
robot::RobotSpec FixtureRobotWithHand();

// Everything off that blurs numbers: no noise, no lattice. Starts lying.
config::Config FixtureConfig();

// The fixture robot, or another one with the same model, on its ground.
physics::MujocoWorld FixtureWorld(const robot::RobotSpec& spec = FixtureRobot(),
                                  double timestep = 0.001);

std::filesystem::path FixtureFile(const std::string& name);  // in tests/data

// Names of the joints in the order of the motors, of the MJCF's joints, of the MJCF's actuators.
std::vector<std::string> MotorOrder(const robot::RobotSpec& spec);
std::vector<std::string> JointOrder(const mjModel& model);
std::vector<std::string> ActuatorOrder(const mjModel& model);

// Joint torques [N·m] of a stiff spring and damper that hold `q` [rad], both in motor order.
std::vector<double> Hold(const physics::RobotBody& robot, const std::vector<double>& q);

}  // namespace understudy::test
