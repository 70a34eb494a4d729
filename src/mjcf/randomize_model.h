// Randomizes a compiled model.
#ifndef UNDERSTUDY_MJCF_RANDOMIZE_MODEL_H_
#define UNDERSTUDY_MJCF_RANDOMIZE_MODEL_H_

#include "mjcf/mujoco_handles.h"
#include "robot/randomization.h"

namespace understudy::mjcf {

// Draws all that `ranges` asks of the model and puts it in. Bodies are the robot's: the base and
// what hangs from it, those that weigh something; joints its motors'. What MuJoCo derives from
// masses is derived anew. `model` is LoadWorldModel's for the same spec.
void RandomizeModel(const robot::RandomizationSpec& ranges, const robot::RobotSpec& robot,
                    robot::Dice* dice, mjModel* model);

}  // namespace understudy::mjcf

#endif  // UNDERSTUDY_MJCF_RANDOMIZE_MODEL_H_
