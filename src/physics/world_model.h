// Compiles a world from the robots' MJCF and the scene's MJCF.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "mjcf/rewrite.h"
#include "objects/object_kinds.h"
#include "physics/robot_body.h"

namespace understudy::physics {

// A name that composing adds to the user's model.
inline constexpr char kClampName[] = "understudy_clamp";

// Notes for the user about a model.
struct LoadNotes {
  std::vector<mjcf::Rewrite> rewrites;  // changes for this MuJoCo, file by file
  // Omissions, substitutions and MuJoCo's warnings, one line each.
  std::vector<std::string> warnings;
  std::vector<std::string> looks;  // visual-only elements that were not compiled, one line per file
  std::vector<std::string> unknown;  // from LoadModelFile that throws: see UnknownWords
};

// What is around the robots: the MJCF file of a scene, and objects in it.
struct Surroundings {
  // NOLINTNEXTLINE(google-explicit-constructor): most worlds have no objects
  Surroundings(std::filesystem::path scene_file, std::vector<objects::ObjectSpec> with = {})
      : file(std::move(scene_file)), objects(std::move(with)) {}

  std::filesystem::path file;
  std::vector<objects::ObjectSpec> objects;
};

// Compiles the robots in the scene at the given time step [s]: each where its `x` and `y` say,
// with its hands on (mjcf/mount.h), where its description differs from its file as the description
// has it (mjcf/revise.h) and, where
// the base has a free joint, with an inactive weld of the base to the world. Joints have the
// figures that the description's `dynamics` ask for (physics/joint_dynamics.h). MuJoCo's own
// actuators and sensors are switched off: motors and readings are ours. Several robots have their
// prefixes before their names, and the options of the first (mjcf/join.h). When a robot's file
// brings ground of its own (a plane or height field of the world), the scene is left out, which is
// noted; the objects stay. Before MuJoCo 3 a file written for MuJoCo 3 is rewritten first
// (mjcf/rewrite.h), and visual-only elements are left out (mjcf/looks.h). `notes` may be null.
//
// Throws ModelError, naming the file and what was expected, when a file is missing or malformed or
// cannot be rewritten, when the base body, a motor's joint, a site or a foot geom is not in the
// model (with the nearest name that is and the key that names it), when a motor's joint is not a
// hinge or slide, when the base is neither free nor fixed to the world, when files of several
// robots cannot be joined, when an object has the name of another body, or when the integrator is
// RK4, which cannot be split around the motor law.
mjcf::ModelHandle LoadWorldModel(const std::vector<PlacedRobot>& robots, const Surroundings& around,
                                 double timestep, LoadNotes* notes = nullptr);

// Compiles the same world for viewers, with its visual-only elements if all of them can be read,
// and with the cameras of the robots. `looks` has for each robot a file or folder whose visual
// meshes draw it (mjcf/look.h), or ""; where MuJoCo cannot read those, robots have their own
// shapes. Bodies, joints and positions are those of the world, geoms are not. The descriptions are
// those with which the world was loaded, or the fitted ones. Throws as above.
mjcf::ModelHandle LoadSightModel(const std::vector<PlacedRobot>& robots, const Surroundings& around,
                                 double timestep, const std::vector<std::string>& looks = {});

// Makes sure that LoadSightModel can draw the robot by that look, and returns what it is drawn by,
// for the user. Throws ModelError where it cannot.
std::string CheckLook(const PlacedRobot& robot, const std::string& look);

struct FittedModel {
  robot::RobotSpec spec;  // with the names of the model
  mjcf::ModelHandle model;
};

// The same for a third-party model of one robot: names of the description that the model lacks are
// replaced by the model's (mjcf/fit_names.h), and feet are searched (physics/feet.h), each with a
// warning in `notes`. Throws as above for what is not found.
FittedModel LoadFittedModel(const PlacedRobot& robot, const Surroundings& around, double timestep,
                            LoadNotes* notes);

// Compiles one MJCF file, rewritten as above where this MuJoCo needs that. `notes` may be null.
// Throws ModelError with MuJoCo's message and the file and line it is about.
mjcf::ModelHandle LoadModelFile(const std::filesystem::path& file, LoadNotes* notes = nullptr);

}  // namespace understudy::physics
