// Randomizes a compiled model.
#pragma once

#include <span>

#include "mjcf/mujoco_handles.h"
#include "robot/randomization.h"

namespace understudy::mjcf {

// Draws the model's quantities in `ranges` and sets them: friction, softness and gravity once for
// the world, the others for each robot; the bases' centres of mass move alike. Bodies are the base
// and its subtree, as far as they have mass; joints are those of the motors. Recomputes the
// constants that MuJoCo derives from masses. `model` is that of LoadWorldModel for those robots,
// whose descriptions must have its names.
void RandomizeModel(const robot::RandomizationSpec& ranges,
                    std::span<const robot::RobotSpec> robots, robot::Randomizer* randomizer,
                    mjModel* model);

}  // namespace understudy::mjcf
