// Rewrites models that were written for MuJoCo 3 so that MuJoCo 2.2.2 reads them.
//
// What is carried over (docs/own_robot.md has the table):
//   joint actuatorfrcrange      forcerange of the joint's actuator, divided by its gear
//   sensor jointactuatorfrc     actuatorfrc of the joint's actuator, same place and name
//   position kv, dampratio      the same law as a general actuator
//   position inheritrange       ctrlrange from the joint's range
//   autolimits, on by default   autolimits="true"
//   content_type, looks, solver settings that change no equation    left out
// What 2.2.2 cannot express is refused by name.
#pragma once

#include <string>
#include <vector>

#include "mjcf/document.h"

namespace understudy::mjcf {

// One change to a model.
struct Rewrite {
  MjcfPlace place;
  std::string what;  // "actuatorfrcrange -88 88 became forcerange -88 88 of actuator 'knee'"
  std::string why;

  std::string text() const { return place.text() + ": " + what + " (" + why + ")"; }
};

// Rewrites the tree for MuJoCo 2.2.2 and appends the changes to `rewrites`. With MuJoCo 3 it does
// nothing.
//
// Throws ModelError with file and line for what cannot be converted: an actuatorfrcrange on a joint
// that two actuators, or an actuator with another transmission than a joint, may drive, or a
// dampratio of such an actuator.
void RewriteForMujoco2(MjcfElement* root, std::vector<Rewrite>* rewrites);

}  // namespace understudy::mjcf
