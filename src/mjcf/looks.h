// Removes visual-only geoms from a running model: nobody looks at it, so they need no compiling.
#pragma once

#include <set>
#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

struct LeftOutLooks {
  int geoms = 0, meshes = 0, textures = 0;
  // Missing files that only visual elements name: "go2.xml:49: <mesh> file: no file".
  std::vector<std::string> missing;

  // "34 geoms, 17 meshes and 2 textures that are only looked at were left out"; "" where no geom or
  // mesh was.
  std::string text() const;
};

// Returns the geoms that are only looked at: they collide with nothing, weigh nothing and are named
// nowhere. Their addresses hold while no element of the tree is added or removed.
std::set<const MjcfElement*> VisualGeoms(const MjcfElement& root);

// Leaves out, exactly for the motion and for every reading: geoms that collide with nothing, weigh
// nothing (their body has an <inertial>, or mass or density of theirs is 0) and are named nowhere;
// meshes that no geom has any more; skins, textures. Where the compiler takes inertia from geoms
// (inertiafromgeom="true") all geoms stay.
LeftOutLooks LeaveOutLooks(MjcfElement* root);

}  // namespace understudy::mjcf
