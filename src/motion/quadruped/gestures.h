// What the gestures of a quadruped look like.
#ifndef UNDERSTUDY_MOTION_QUADRUPED_GESTURES_H_
#define UNDERSTUDY_MOTION_QUADRUPED_GESTURES_H_

#include <cstddef>
#include <span>

#include "motion/quadruped/stance.h"

namespace understudy::motion {

// A pose on the way, in a robot's own measure: lengths are parts of the leg's, heights are over the
// robot's standing height.
struct Keyframe {
  double duration = 1;  // s to get there
  StancePose pose;
};

// All shapes are assumed: no recording of a real robot's gestures with its joint angles is public.
std::span<const Keyframe> HelloKeyframes();  // shifts its weight, lifts the front right paw, waves
std::span<const Keyframe> StretchKeyframes();  // chest down and back, then rump down
const StancePose& PosePosture();

// The last of the keyframes above that put the robot back on its feet: from there a gesture that is
// stopped goes on.
inline constexpr std::size_t kKeyframesBack = 2;

}  // namespace understudy::motion

#endif  // UNDERSTUDY_MOTION_QUADRUPED_GESTURES_H_
