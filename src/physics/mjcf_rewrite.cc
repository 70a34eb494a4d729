#include "physics/mjcf_rewrite.h"

#include <mujoco/mujoco.h>

#include "physics/mjcf_actuators.h"
#include "physics/mjcf_drop.h"

namespace understudy {

RewrittenModel ReadForThisMujoco(const std::filesystem::path& file) {
  RewrittenModel model{ReadMjcf(file), {}};
#if mjVERSION_HEADER < 300
  RewriteForMujoco2(&model.root, &model.rewrites);
#endif
  return model;
}

void RewriteForMujoco2(MjcfElement* root, std::vector<Rewrite>* rewrites) {
  DropWhatChangesNothing(root, rewrites);
  SayAutolimits(root, rewrites);
  // From here on no element comes or goes: what follows points into the tree.
  const MjcfDefaults defaults(*root);
  MjcfJoints joints = CollectJoints(root, defaults);
  LimitActuators(root, defaults, &joints, rewrites);
  RenameTorqueSensors(root, defaults, &joints, rewrites);
  SpellOutPositionGains(root, defaults, &joints, rewrites);
}

}  // namespace understudy
