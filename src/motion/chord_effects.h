// What the chords of a robot's remote controller lead to, by the tables of its motion service.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::motion {

// A state of a motion service, as robot::MotionState has it.
struct StateName {
  int id = 0;
  std::string name{};
};

// Returns the states of the robot's motion service, each id once.
std::vector<StateName> StateNames(const robot::RobotSpec& spec);

// From one state to the one that lasts. Both are ids.
struct ChordEffect {
  int from = 0, to = 0;
};

// What the motion service does with the goal of a chord. A chord of debug mode, which no motion
// service gets, has no effects.
struct ChordEffects {
  std::string name{};                  // of what it does, for people: "stand up", "ready", "run"
  bool simulated = true;               // false: only the real robot does it
  std::vector<ChordEffect> effects{};  // of each state in which the goal is taken
};

// Throws ConfigError for a chord that authority::MakeChord refuses.
ChordEffects EffectsOf(const robot::RobotSpec& spec, const robot::ChordSpec& chord);

}  // namespace understudy::motion
