// Plays arm actions.
#pragma once

#include <span>
#include <vector>

#include "authority/motion.h"
#include "motion/humanoid/arm_poses.h"
#include "motion/humanoid/body_model.h"
#include "motion/joint_move.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// Computes the joint angles of the arms during arm actions. Joints that a robot lacks are skipped;
// angles are clamped to the joints' ranges. Allocates only in the constructor.
class ArmActionPlayer {
 public:
  // The arms rest as in `spec.standing`. Ranges are read from `body`, which need not outlive the
  // player.
  ArmActionPlayer(const robot::RobotSpec& spec, const BodyModel& body);

  // Starts the vendor's action `id` or returns the reason why not: kNotNow while another one is
  // under way or held, kUnknown, kUnable. Id 99 and the id of a held action lower the arms.
  authority::MotionVerdict Begin(int id);
  void Release();  // lowers the arms from any pose
  void Reset();    // immediately at rest

  void Advance(double dt);

  int id() const { return action_ == nullptr ? 0 : action_->id; }  // until the arms are down
  bool holding() const { return action_ != nullptr && holding_; }
  // The same for programs: 99 after a release, until the next action.
  int told() const { return action_ == nullptr && released_ ? kReleaseArms : id(); }

  // The motors of the arms and their target angles, those at rest while no action is under way.
  std::span<const int> motors() const { return motors_; }
  double q(std::size_t i) const { return move_.q(i); }    // rad, of motors()[i]
  double dq(std::size_t i) const { return move_.dq(i); }  // rad/s

 private:
  struct Place {
    bool left = false;
    std::size_t joint = 0;  // in ArmPose
    double rest = 0, low = 0, high = 0;
  };

  void GoTo(const ArmKey& key);

  std::vector<int> motors_;
  std::vector<Place> places_;
  std::vector<double> from_, to_;
  JointMove move_{0};
  const ArmSequence* action_ = nullptr;
  std::size_t next_key_ = 0;
  bool holding_ = false;
  bool releasing_ = false;
  bool released_ = false;  // the last that was done was to lower the arms
  double held_ = 0;        // s
};

}  // namespace understudy::motion
