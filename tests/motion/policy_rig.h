// Policies made by hand for robots under their motion service.
#pragma once

#include <string>
#include <vector>

#include "base/temporary_folder.h"
#include "config/config.h"
#include "policy/network.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// What a handmade policy's motors do at actions of 0, in motor order.
struct PolicyPose {
  std::vector<double> q, kp, kd;  // rad, N·m/rad, N·m·s/rad
};

// A definition and its weights in a folder of their own.
class PolicyFiles {
 public:
  // A definition with the robot's slots, `observations` in YAML with two spaces before each term,
  // and that network.
  PolicyFiles(const robot::RobotSpec& spec, const PolicyPose& pose, const std::string& observations,
              const std::vector<policy::Layer>& layers, const std::string& activation);

  std::string definition() const { return folder_.path() / "deploy.yaml"; }
  std::string weights() const { return folder_.path() / "deploy.safetensors"; }
  // Replaces text of the definition.
  void Change(const std::string& from, const std::string& to) const;

 private:
  TemporaryFolder folder_{"policy"};
};

// The settings with which a motion service plays it.
std::vector<std::string> Plays(const std::string& service, const PolicyFiles& policy);

// A trot of a Go2 in strides of 0.4 s, made of the gait's phase and the commanded velocity ahead:
// the network of relu multiplies them. It stands while nothing is commanded.
PolicyFiles TrotOfGo2();

// A G1 that holds its standing pose; ankles work against tilt and its rate, and
// the waist turns by half of the commanded rate of turn.
PolicyFiles StandOfG1();

}  // namespace understudy::motion
