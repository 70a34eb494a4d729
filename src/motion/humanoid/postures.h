// A humanoid whose motors only brake, and one whose joints are locked.
#pragma once

#include <span>

#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/joint_move.h"

namespace understudy::motion {

// Lies or hangs, its motors braking or limp.
class Slack final : public HumanoidBehaviour {
 public:
  // What is handed over must outlive it.
  Slack(const JointGains& gains, Bearing* bearing) : gains_(gains), bearing_(bearing) {}

  void Begin(bool limp) { limp_ = limp; }
  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return true; }

 private:
  const JointGains& gains_;
  Bearing* bearing_;
  bool limp_ = true;
};

// Stiff springs lead all joints to a posture and hold it; the weight is carried where it is.
class LockedPosture final : public HumanoidBehaviour {
 public:
  // Likewise.
  LockedPosture(const JointGains& gains, Bearing* bearing)
      : gains_(gains), bearing_(bearing), move_(gains.kp.size()) {}

  // To the angles `to` [rad] in `duration` s.
  void Begin(const HumanoidReading& sensed, std::span<const double> to, double duration) {
    move_.Begin(sensed.q, to, duration);
  }
  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return move_.over(); }  // it is there

 private:
  const JointGains& gains_;
  Bearing* bearing_;
  JointMove move_;
};

}  // namespace understudy::motion
