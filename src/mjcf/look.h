// Draws a robot by the visual meshes of another copy of its model, such as the vendor's.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

// What a body is drawn with.
struct LookOfBody {
  std::string body;
  std::vector<MjcfElement> geoms;  // of meshes, in the frame of the body
};

struct Look {
  std::filesystem::path file;       // MJCF or URDF of which the meshes are
  std::vector<MjcfElement> meshes;  // <mesh>, with absolute files and names of their own
  std::vector<LookOfBody> bodies;   // those of the robot that have meshes
};

// Finds the meshes of a robot, given by its tree, in `place`: a file of MJCF or URDF, or a folder
// with such files, also in folders below. Of several files it takes the one that has meshes for
// most bodies of the robot, of those the one whose bodies stand most as the robot's, of those the
// one with fewest joints beyond the robot's, then with most meshes. Bodies are known by their names
// or those of their joints; what hangs on one and is no body of the robot's is drawn with it.
//
// Throws ModelError, naming what was looked for, if there is no such file, or none with a mesh for
// a body of the robot: also if the mesh files are missing or MuJoCo cannot read them.
Look FindLook(const std::filesystem::path& place, const MjcfElement& robot);

// Gives the robot that look: each body of it loses its own visual geoms. Nothing that collides or
// weighs changes.
void PutOn(const Look& look, MjcfElement* robot);

}  // namespace understudy::mjcf
