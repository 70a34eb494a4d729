// Writes a robot of a compiled model as URDF, the form of robot that ROS tools and viewers read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// What the drive of a joint can do.
struct UrdfLimits {
  double effort = 0;    // N·m or N
  double velocity = 0;  // rad/s or m/s
};

// A mesh that the URDF names as "meshes/<name>.stl".
struct UrdfMesh {
  std::string name;
  std::string stl;  // binary
};

struct Urdf {
  std::string text;
  std::vector<UrdfMesh> meshes;
};

// Describes the body `base` and all below it: links have the names of bodies and their frames,
// joints those of joints, with range, damping and friction, and of `limits` what is there, by
// joint. A joint that is not at the origin of its body gets a link without mass at its place,
// "<joint>_place". URDF has neither capsules nor ellipsoids: they become a cylinder between two
// spheres, and a sphere around. Geoms of groups 0 to 2 are visual, those that can collide are
// collision. Throws ModelError for a ball joint, which URDF has not, and for what has no name.
Urdf UrdfOf(const mjModel& model, const std::string& robot, const std::string& base,
            const std::map<std::string, UrdfLimits>& limits = {});

}  // namespace understudy::mjcf
