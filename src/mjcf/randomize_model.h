// Randomizes a compiled model.
#pragma once

#include "mjcf/mujoco_handles.h"
#include "robot/randomization.h"

namespace understudy::mjcf {

// Draws all that `ranges` asks of the model and puts it in. Bodies are the robot's: the base and
// what hangs from it, those that weigh something; joints its motors'. What MuJoCo derives from
// masses is derived anew. `model` is LoadWorldModel's for the same spec.
void RandomizeModel(const robot::RandomizationSpec& ranges, const robot::RobotSpec& robot,
                    robot::Dice* dice, mjModel* model);

}  // namespace understudy::mjcf
