// Writes a robot of a compiled model as URDF, the form of robot that ROS tools and viewers read.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "mjcf/robot_tree.h"

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

// A mesh as a file beside the URDF, or, where there can be no file, as a cylinder if it is long and
// about round, else as the box around it.
enum class MeshUse { kFiles, kPrimitives };

// Describes a robot's `tree` of `model`, with range, damping and friction of the joints, and of
// `limits` what is there, by joint. URDF has neither capsules nor ellipsoids: they become a
// cylinder between two spheres, and a sphere around. Geoms of groups 0 to 2 are visual, those that
// can collide are collision. Throws ModelError for planes, height fields and meshes without names.
Urdf UrdfOf(const mjModel& model, const std::string& robot, const RobotTree& tree,
            const std::map<std::string, UrdfLimits>& limits = {}, MeshUse meshes = MeshUse::kFiles);

}  // namespace understudy::mjcf
