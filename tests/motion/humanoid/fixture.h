// A humanoid on flat ground under its motion service.
#pragma once

#include "tests/motion/rig.h"
#include "tests/support/mujoco_test.h"

namespace understudy::motion {

// config/robots/<robot>.yaml; "g1 6" is its hardware revision 6, "g1 dex1" bears these hands.
config::Config HumanoidConfig(const std::string& robot, double timestep = 0.001);

class HumanoidRig : public MotionRig {
 public:
  using MotionRig::MotionRig;
  explicit HumanoidRig(const std::string& robot, double timestep = 0.001)
      : MotionRig(HumanoidConfig(robot, timestep)) {}

  authority::MotionVerdict SetFsm(int id) { return Ask(goal::SetFsm{id}); }
  // From the crane to the ground into the state `id`, the crane gone.
  void SetDown(int id);

  bool standing() const { return tilt() < 0.4 && height() > 0.75 * spec().standing.height; }
  double Load() const;                // N on the feet
  double DeepestSelfContact() const;  // m, 0 when it does not touch itself
  double q(const std::string& joint) const;
};

}  // namespace understudy::motion
