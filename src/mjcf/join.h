// Joins several robots in one model: with unique names, separate defaults and one set of options.
#pragma once

#include <string>
#include <vector>

#include "mjcf/document.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// Adds `prefix` to every name in the tree and every reference to one. The defaults become named
// classes, so that they apply only to this robot. Keyframes, which list the joints of the whole
// model, are removed.
void AddPrefix(const std::string& prefix, MjcfElement* root);

// Adds `prefix` to all names of the model's elements in a description.
robot::RobotSpec WithPrefix(const std::string& prefix, robot::RobotSpec spec);

// Moves the children of the world body by x and y [m].
void MoveBodies(double x, double y, MjcfElement* root);

// Appends a second robot's tree to `root`, both after AddPrefix. The options of `root` apply to
// both: a different one of `other` is dropped, with a line in `warnings`. Throws ModelError with
// file and line if their <compiler> elements are incompatible.
void Join(MjcfElement other, MjcfElement* root, std::vector<std::string>* warnings);

}  // namespace understudy::mjcf
