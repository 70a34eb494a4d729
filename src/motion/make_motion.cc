#include "motion/make_motion.h"

#include "base/errors.h"
#include "motion/damping_motion.h"
#include "motion/humanoid/motion.h"
#include "motion/protection.h"
#include "motion/quadruped/motion.h"

namespace understudy::motion {
namespace {

// Ids of the vendor: Go2 motion services V2.0, where `mode` is that of firmware before 1.1.6, and
// the humanoids' loco services. That other quadrupeds have the Go2's is *assumed*.
const robot::MotionState kQuadrupedDamped{.id = 1001, .name = "damping", .mode = 7};
const robot::MotionState kHumanoidDamped{.id = 1, .name = "damping"};
const robot::MotionState kHumanoidLimp{.id = 0, .name = "zero torque"};

// The service itself.
std::unique_ptr<authority::Motion> MakeBare(const robot::RobotSpec& spec,
                                            const physics::RobotBody& body, double damping_kd) {
  try {
    if (spec.kind == robot::RobotKind::kHumanoid) return MakeHumanoidMotion(spec, body);
    if (robot::IsQuadruped(spec.kind)) return MakeQuadrupedMotion(spec, body);
  } catch (const ModelError&) {
    // A third-party model whose feet are not found can only damp.
  }
  const bool quadruped = robot::IsQuadruped(spec.kind);
  return std::make_unique<DampingMotion>(quadruped ? kQuadrupedDamped : kHumanoidDamped,
                                         quadruped ? kQuadrupedDamped : kHumanoidLimp, damping_kd);
}

}  // namespace

std::unique_ptr<authority::Motion> MakeMotion(const robot::RobotSpec& spec,
                                              const physics::RobotBody& body, double damping_kd) {
  return std::make_unique<ProtectedMotion>(spec, body, MakeBare(spec, body, damping_kd));
}

}  // namespace understudy::motion
