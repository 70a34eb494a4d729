// The gaits of a quadruped, by the vendor's names.
#pragma once

#include <array>
#include <span>
#include <string_view>

#include "authority/goals.h"
#include "robot/motion_spec.h"

namespace understudy::motion {

// One gait. What it does it says in parts of the robot's own figures,
// `robot.motion.quadruped.walk`; the reported gait is the vendor's.
struct GaitRow {
  authority::goal::GaitName gait;
  std::string_view name;
  double period, raise, speed;    // parts of the robot's own, `speed` of the range on every axis
  double duty;                    // added to the robot's own
  std::array<double, 4> offsets;  // part of a stride at which FR FL RR RL touch down
  int id;                         // SportModeState.error_code, where that tells the state
  int type;                       // .gait_type before
  int standing, moving;           // .mode before, standing still in this gait and walking
};

std::span<const GaitRow> GaitRows();
// Not for kNone.
const GaitRow& RowOf(authority::goal::GaitName gait);

// What a speed level, -1 to 1, makes of velocities; *assumed* but that levels scale.
struct SpeedScale {
  double range;   // of what is taken of a Move
  double sticks;  // of what the remote controller's sticks mean
};
SpeedScale ScaleOf(int level);

// How that robot walks in that gait at that speed level.
robot::WalkSpec WalkIn(const GaitRow& gait, int level, const robot::WalkSpec& own);

}  // namespace understudy::motion
