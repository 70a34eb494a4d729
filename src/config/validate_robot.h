// Checks conditions that span several keys of a robot.
#pragma once

#include <string>

#include "base/errors.h"
#include "config/reader.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// Checks a condition on a key; the error says where the key was set.
class Checker {
 public:
  // `places` must outlive the checker.
  explicit Checker(const Places& places) : places_(places) {}

  // Throws ConfigError "file:line: key: what" unless `fits`.
  void Check(bool fits, const std::string& key, const std::string& what) const {
    if (!fits) throw ConfigError(Where(key) + key + ": " + what);
  }

  // Returns "file:line: ", "" if the key has its default.
  std::string Where(const std::string& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? "" : place->second + ": ";
  }

 private:
  const Places& places_;
};

// Throws ConfigError for the first failed condition: the robot must have a name, a model and
// motors; slots must ascend and exist in the message family; speeds, poses, parallel pairs and
// battery voltages must be consistent.
void ValidateRobot(const robot::RobotSpec& robot, const Checker& checker);

// Throws ConfigError unless `pose`, the value of `key`, is a start pose.
void CheckStartPose(const std::string& pose, const std::string& key, const Checker& checker);

}  // namespace understudy::config
