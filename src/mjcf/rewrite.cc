#include "mjcf/rewrite.h"

#include "mjcf/actuators.h"
#include "mjcf/drop.h"

namespace understudy::mjcf {

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

}  // namespace understudy::mjcf
