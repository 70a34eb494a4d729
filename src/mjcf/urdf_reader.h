// Reads URDF, the form in which ROS and robot makers describe robots, as MJCF.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

// A joint that moves: revolute, continuous or prismatic.
struct UrdfReadJoint {
  std::string name;
  double effort = 0;                           // N·m or N; 0 = the file does not say
  double velocity = 0;                         // rad/s or m/s; 0 = the file does not say
  std::optional<std::array<double, 2>> range;  // rad or m; nullopt: it has none
};

// A mesh file, and where the model looks for it, seen from its own folder: "meshes/trunk.stl".
struct UrdfReadMesh {
  std::filesystem::path from;
  std::string to;
  std::string stl;  // its content there, made of a part of `from`, a .dae; "": it is copied
};

struct UrdfRobot {
  MjcfElement model;  // <mujoco>: no actuators, no sites, no ground
  // The link without a parent, or the one that a floating joint ties to an empty link without a
  // parent, such as "world" or "odom"; its body has a free joint.
  std::string base;
  bool fixed = false;  // the base hangs on an empty link "world" by a fixed joint: no free joint
  std::vector<UrdfReadJoint> joints;  // in the order of the tree, children after parents
  std::vector<std::string> bodies;    // in the order of the tree; the base is the first
  std::vector<UrdfReadMesh> meshes;
  std::vector<std::string> notes;  // what was left out or made up, one line each
};

// What becomes of meshes in .dae files: they are read, or only named, for who reads some later.
enum class DaeUse { kRead, kNamed };

// Reads a URDF file. Bodies have the names and frames of links, joints those of joints, with axis,
// range, damping and friction; links that are fixed to others stay bodies of their own. Geoms of
// <collision> are named "<link>_collision", "_collision_2" ...; they meet the ground and not each
// other. <visual> has looks alone; a link whose looks are all left out looks as it collides. A mesh
// is looked for beside the file and, by the name of its package, in the folders above; MuJoCo reads
// STL, OBJ and MSH. What moves and has no mass gets a gram, an inertia that no body has is repaired
// (urdf_inertial.h). The rotor's inertia, of which URDF says nothing, is 0.01 kg·m² (*assumed*).
//
// Throws ModelError with file and line for a file that is not URDF (also xacro, which its own
// program expands), links that form no tree, joints of other kinds, numbers that are none, and
// colliding meshes that are missing or of another format.
UrdfRobot ReadUrdf(const std::filesystem::path& file, DaeUse dae = DaeUse::kRead);

// Returns MJCF as indented text, `comment` before its first element.
std::string IndentedMjcf(const MjcfElement& root, const std::string& comment);

}  // namespace understudy::mjcf
