// What has to fit together within a robot.
#pragma once

#include <string>

#include "base/errors.h"
#include "config/reader.h"
#include "robot/robot_spec.h"

namespace understudy::config {

// A condition on a key, told with where the key was set.
class Checker {
 public:
  // `places` must outlive the checker.
  explicit Checker(const Places& places) : places_(places) {}

  // Throws ConfigError, "file:line: key: what", unless it fits.
  void Check(bool fits, const std::string& key, const std::string& what) const {
    if (!fits) throw ConfigError(Where(key) + key + ": " + what);
  }

  // "file:line: ", "" where no file and no option set it.
  std::string Where(const std::string& key) const {
    const auto place = places_.find(key);
    return place == places_.end() ? "" : place->second + ": ";
  }

 private:
  const Places& places_;
};

// Throws ConfigError at the first thing that does not fit: a robot without name, model or motors;
// slots that are not ascending or that the message family lacks; speeds, poses, parallel pairs and
// battery voltages that contradict each other.
void ValidateRobot(const robot::RobotSpec& robot, const Checker& checker);

// `pose`, the value of `key`, is one to start in.
void CheckStartPose(const std::string& pose, const std::string& key, const Checker& checker);

}  // namespace understudy::config
