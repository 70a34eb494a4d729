// The links and joints of a robot of a compiled model, as URDF and ROS have them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Geometry>

#include "mjcf/mujoco_handles.h"

namespace understudy::mjcf {

// A joint and the link behind it. Rotated by q about `axis`, or shifted by q along it, the link is
// where MuJoCo has it at qpos = q.
struct TreeJoint {
  enum class Kind { kFixed, kHinge, kSlide };

  std::string name;
  Kind kind = Kind::kFixed;
  std::string parent{}, child{};                           // links
  Eigen::Isometry3d X_PC = Eigen::Isometry3d::Identity();  // child in its parent at q = 0
  Eigen::Vector3d axis = Eigen::Vector3d::Zero();          // in the child
  // MuJoCo's ids; -1: there is none, of a fixed joint or of a link that is no body.
  int joint = -1, body = -1;
  int qpos = -1, dof = -1;  // places in qpos and qvel

  // The child's pose in its parent at `q` [rad or m].
  Eigen::Isometry3d At(double q) const;
};

struct RobotTree {
  std::string base;  // the first link
  // Place in qpos of the base's position and quaternion (w, x, y, z); -1: the base is fixed, and
  // its pose in the world never changes.
  int base_qpos = -1;
  Eigen::Isometry3d X_WB = Eigen::Isometry3d::Identity();  // as the model's file has it
  std::vector<TreeJoint> joints{};                         // parents before their children
};

// Returns the name of an element of a robot, of MuJoCo's type `type`. Throws ModelError if it has
// none.
const char* RobotsName(const mjModel& model, int type, int id);

// Describes the body `base` and all below it. Links have the names of bodies and their frames. A
// joint that is not at the origin of its body gets a link of its own there, "<joint>_place", and
// between the links of two joints of a body, or where there is none, is a fixed joint
// "<body>_fixed". Throws ModelError for a joint that is neither hinge nor slide, for what has no
// name, and if there is no such body.
RobotTree TreeOf(const mjModel& model, const std::string& base);

}  // namespace understudy::mjcf
