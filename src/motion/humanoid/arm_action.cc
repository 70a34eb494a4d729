#include "motion/humanoid/arm_action.h"

#include <algorithm>
#include <limits>
#include <string>

namespace understudy::motion {
namespace {

constexpr double kLongestHold = 20;  // s: unitree_sdk2 g1_arm_action_client.hpp
constexpr double kLetDown = 1.4;     // s, assumed

}  // namespace

ArmActionPlayer::ArmActionPlayer(const robot::RobotSpec& spec, const BodyModel& body) {
  constexpr double kFar = std::numeric_limits<double>::max();
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    for (std::size_t joint = 0; joint < kArmJoints; ++joint) {
      const std::string name = std::string(kArmJointNames[joint]) + "_joint";
      const bool left = spec.motors[i].joint == "left_" + name;
      if (!left && spec.motors[i].joint != "right_" + name) continue;
      motors_.push_back(static_cast<int>(i));
      places_.push_back({.left = left,
                         .joint = joint,
                         .rest = spec.standing.q[i],
                         .low = body.WithinRange(i, -kFar),
                         .high = body.WithinRange(i, kFar)});
    }
  }
  from_.resize(motors_.size());
  to_.resize(motors_.size());
  move_ = JointMove(motors_.size());
  Reset();
}

authority::MotionVerdict ArmActionPlayer::Begin(int id) {
  const ArmSequence* action = FindArmSequence(id);
  if (id != kReleaseArms && action == nullptr) {
    return IsUnplayedArmAction(id) ? authority::MotionVerdict::kUnable
                                   : authority::MotionVerdict::kUnknown;
  }
  if (action_ != nullptr) {
    if (!holding_ || (id != kReleaseArms && id != action_->id))
      return authority::MotionVerdict::kNotNow;
    Release();
    return authority::MotionVerdict::kTaken;
  }
  released_ = id == kReleaseArms;
  if (released_) return authority::MotionVerdict::kTaken;
  action_ = action;
  next_key_ = 1;
  holding_ = releasing_ = false;
  held_ = 0;
  GoTo(action->keys.front());
  return authority::MotionVerdict::kTaken;
}

void ArmActionPlayer::Release() {
  if (action_ == nullptr || releasing_) return;
  holding_ = false;
  releasing_ = true;
  GoTo({.duration = kLetDown});
}

void ArmActionPlayer::Reset() {
  action_ = nullptr;
  holding_ = releasing_ = false;
  for (std::size_t i = 0; i < places_.size(); ++i) to_[i] = places_[i].rest;
  move_.Begin(to_, to_, 0);
}

void ArmActionPlayer::Advance(double dt) {
  if (action_ == nullptr) return;
  move_.Advance(dt);
  if (!move_.over()) return;
  if (!releasing_ && next_key_ < action_->keys.size()) {
    GoTo(action_->keys[next_key_++]);
  } else if (releasing_ || !action_->holds) {
    released_ = releasing_;
    Reset();
  } else {
    holding_ = true;
    held_ += dt;
    if (held_ > kLongestHold) Release();
  }
}

void ArmActionPlayer::GoTo(const ArmKey& key) {
  for (std::size_t i = 0; i < places_.size(); ++i) {
    const Place& place = places_[i];
    const ArmPose* pose = place.left ? key.left : key.right;
    double q = place.rest;
    if (pose != nullptr) q = place.left ? (*pose)[place.joint] : Mirrored(*pose, place.joint);
    from_[i] = move_.q(i);
    to_[i] = std::clamp(q, place.low, place.high);
  }
  move_.Begin(from_, to_, key.duration);
}

}  // namespace understudy::motion
