// The plain part of the rewriting: attributes that MuJoCo 2.2.2 can do without or calls otherwise.
#pragma once

#include <vector>

#include "mjcf/document.h"
#include "mjcf/rewrite.h"

namespace understudy::mjcf {

// Leaves out or renames what a table lists. A setting that would change the robot's motion is left
// out only at the value that 2.2.2 has built in; at any other it stays for MuJoCo to refuse.
void DropWhatChangesNothing(MjcfElement* root, std::vector<Rewrite>* rewrites);

// MuJoCo 3 limits what has a range; 2.2.2 asks for a word.
void SayAutolimits(MjcfElement* root, std::vector<Rewrite>* rewrites);

}  // namespace understudy::mjcf
