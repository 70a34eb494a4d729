// A quadruped under its motion service, and its ways up.
#pragma once

#include "tests/motion/rig.h"

namespace understudy::motion {

class QuadrupedRig : public MotionRig {
 public:
  using MotionRig::MotionRig;
  // One of config/robots with the settings ("KEY=VALUE") given.
  explicit QuadrupedRig(const std::string& robot, const std::vector<std::string>& settings = {},
                        const std::filesystem::path& scene = FlatScene())
      : MotionRig(ConfigOf(robot, settings), scene) {}

  // In the stand that Stand Up leads to, and on to a balanced one.
  void StandUp() {
    Start("lying");
    Run(0.2);
    Ask(goal::StandUp{});
    Run(3);
  }
  void BalanceStand() {
    StandUp();
    Ask(goal::BalanceStand{});
    Run(2);
  }
};

}  // namespace understudy::motion
