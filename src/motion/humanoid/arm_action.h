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

// Where the arms are to be, over what the robot stands with. Joints that a robot lacks are left
// out; angles stop at the joints' range. Allocates in the constructor only.
class ArmActionPlayer {
 public:
  // The arms of `spec.standing` are where they rest. The ranges are read from `body`, which is not
  // kept.
  ArmActionPlayer(const robot::RobotSpec& spec, const BodyModel& body);

  // Begins the vendor's action `id`, or says why not: kNotNow while another one is under way or
  // held, kUnknown, kUnable. 99 and the number of what is held let the arms down.
  authority::MotionVerdict Begin(int id);
  void Release();  // lets the arms down from wherever they are
  void Reset();    // at rest, at once

  void Advance(double dt);

  int id() const { return action_ == nullptr ? 0 : action_->id; }  // until the arms are down
  bool holding() const { return action_ != nullptr && holding_; }

  // Motors of the arms, and where they are to be; rests while nothing is played.
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
  const ArmAction* action_ = nullptr;
  std::size_t next_key_ = 0;
  bool holding_ = false;
  bool releasing_ = false;
  double held_ = 0;  // s
};

}  // namespace understudy::motion
