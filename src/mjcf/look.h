// Draws a robot by the visual meshes of another copy of its model, such as the vendor's.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "base/temporary_folder.h"
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
  // Has the files made of those in .dae, which MuJoCo does not read; null without such. They are
  // there as long as a copy of the look is.
  std::shared_ptr<const TemporaryFolder> made;
};

// Finds the meshes of a robot, given by its tree, in `place`: a file of MJCF or URDF, or a folder
// with such files, also in folders below. Of several files it takes the one that has meshes for
// most bodies of the robot, of those the one whose bodies stand most as the robot's, of those the
// one with fewest joints beyond the robot's, then with most meshes. Bodies are known by their names
// or those of their joints; what hangs on one and is no body of the robot's is drawn with it. Of a
// mesh in .dae each colour is one of the look's own.
//
// Throws ModelError, naming what was looked for, if there is no such file, or none with a mesh for
// a body of the robot: also if the mesh files are missing or of other formats, or a .dae that it
// takes cannot be read. SetupError if a temporary folder cannot be made or is full.
Look FindLook(const std::filesystem::path& place, const MjcfElement& robot);

// Gives the robot that look: each body of it loses its own visual geoms. Nothing that collides or
// weighs changes.
void PutOn(const Look& look, MjcfElement* robot);

}  // namespace understudy::mjcf
