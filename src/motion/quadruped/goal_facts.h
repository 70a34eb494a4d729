// Properties of a quadruped's goals that do not depend on its state.
#pragma once

#include <optional>

#include "authority/goals.h"
#include "motion/quadruped/stance.h"
#include "robot/motion_spec.h"

namespace understudy::motion {

// Whether its numbers are finite, its gait has a name and the times of its path ascend.
bool IsSound(const authority::MotionGoal& goal);

// A gesture, Sit or Pose.
bool IsGesture(const authority::MotionGoal& goal);

// Move, GoTo or FollowPath.
bool IsMove(const authority::MotionGoal& goal);

// The pose that Euler, BodyHeight or BodyPosition makes of `wanted`, cut to the ranges of
// `figures`; none for other goals. `leg_length` in m.
std::optional<StancePose> PoseOf(const authority::MotionGoal& goal, const StancePose& wanted,
                                 const robot::QuadrupedMotionSpec& figures, double leg_length);

}  // namespace understudy::motion
