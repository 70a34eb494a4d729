// Several robots in one model: names that differ, defaults that stay apart, one set of options.
#pragma once

#include <string>
#include <vector>

#include "mjcf/document.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// Puts `prefix` before every name in the tree and before every reference to one. The tree's
// defaults become classes of their own, so that they hold for this robot only. Keyframes, which
// list the joints of the whole model, are removed.
void AddPrefix(const std::string& prefix, MjcfElement* root);

// The same for a description: `prefix` before every name that it has for something in its model.
robot::RobotSpec WithPrefix(const std::string& prefix, robot::RobotSpec spec);

// Moves the bodies that stand in the world by x and y [m].
void MoveBodies(double x, double y, MjcfElement* root);

// Appends a second robot's tree to `root`; both have gone through AddPrefix. The options of `root`
// hold for both: each one of `other` that differs is left out, with a line in `warnings`. Throws
// ModelError with file and line when their <compiler> elements would read the same text
// differently.
void Join(MjcfElement other, MjcfElement* root, std::vector<std::string>* warnings);

}  // namespace understudy::mjcf
