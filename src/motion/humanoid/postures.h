// Behaviours of a humanoid with damped or limp motors and with locked joints.
#pragma once

#include <span>

#include "motion/humanoid/bearing.h"
#include "motion/humanoid/behaviour.h"
#include "motion/humanoid/figures.h"
#include "motion/joint_move.h"

namespace understudy::motion {

// Motors are damped or limp.
class Slack final : public HumanoidBehaviour {
 public:
  // Both must outlive it.
  Slack(const JointGains& gains, Bearing* bearing) : gains_(gains), bearing_(bearing) {}

  void Begin(bool limp) { limp_ = limp; }
  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return true; }

 private:
  const JointGains& gains_;
  Bearing* bearing_;
  bool limp_ = true;
};

// Stiff springs move all joints to a posture and hold it; feed-forward torques carry the weight.
class LockedPosture final : public HumanoidBehaviour {
 public:
  // Both must outlive it.
  LockedPosture(const JointGains& gains, Bearing* bearing)
      : gains_(gains), bearing_(bearing), move_(gains.kp.size()) {}

  // Moves to the angles `to` [rad] in `duration` [s].
  void Begin(const HumanoidReading& sensed, std::span<const double> to, double duration) {
    move_.Begin(sensed.q, to, duration);
  }
  void Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) override;
  bool over() const override { return move_.over(); }  // the posture is reached

 private:
  const JointGains& gains_;
  Bearing* bearing_;
  JointMove move_;
};

}  // namespace understudy::motion
