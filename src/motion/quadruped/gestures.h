// The gestures of a quadruped: what they look like, and how they are played.
#pragma once

#include <cstddef>
#include <span>

#include "authority/goals.h"
#include "motion/quadruped/stance.h"

namespace understudy::motion {

// A pose on the way, in a robot's own measure: lengths are parts of the leg's, heights are over the
// robot's standing height.
struct Keyframe {
  double duration = 1;  // s to get there
  StancePose pose;
};

// All shapes are assumed: no recording of a real robot's gestures with its joint angles is public.
// Those that a real one does on its hind legs are done on three.
std::span<const Keyframe> KeyframesOf(authority::goal::GestureName gesture);
const StancePose& PosePosture();

// A posture in a robot's own measure, in metres.
StancePose InMetres(const StancePose& posture, double leg_length, double stand_height);

// Leads a stance from keyframe to keyframe and then back to a stand.
class KeyframePlayer final : public Behaviour {
 public:
  // `stance` must outlive it and have begun. Lengths in m.
  KeyframePlayer(Stance* stance, double leg_length, double stand_height)
      : stance_(stance), leg_length_(leg_length), stand_height_(stand_height) {
    KeyframesOf({});  // the first call makes them, and no step may allocate
  }

  // `frames` must outlive it; none: back to the stand at once.
  void Begin(std::span<const Keyframe> frames);
  // Goes on with those keyframes that put the robot back on its feet, if it is not there yet.
  void End();
  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;
  bool over() const override { return frame_ == frames_.size() && stance_->over(); }

 private:
  void Play(std::size_t frame);  // past the last: back to the stand

  Stance* stance_;
  double leg_length_, stand_height_;
  std::span<const Keyframe> frames_;
  std::size_t frame_ = 0;
};

}  // namespace understudy::motion
