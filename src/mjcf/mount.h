// Puts hands on the wrists of a robot's tree.
#pragma once

#include <vector>

#include "mjcf/document.h"
#include "robot/robot_spec.h"

namespace understudy::mjcf {

// Each tree of `hands` has bodies with the names of wrists of `root`: a wrist keeps its place and
// joints and takes all else from them. The other sections are added, once where trees include them
// from the same file. Does nothing if `root` has the joint of the hands' first motor. Throws
// ModelError with file and line if `root` has no such wrist, or another <compiler>; that geoms of
// `root` give no inertia matters only to a hand that needs it.
void MountHands(const robot::RobotSpec& spec, std::vector<MjcfElement> hands, MjcfElement* root);

}  // namespace understudy::mjcf
