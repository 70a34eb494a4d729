// What the remote controller's keys ask of the robot.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motion.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// A chord of the robot's table, ready to act.
struct Chord {
  std::uint16_t keys = 0;
  int clicks = 1;
  std::optional<MotionGoal> goal;  // none: the motion service lets go (debug mode)
  std::vector<int> from;           // ids of states it works in; none = in all
};

// The words of ChordSpec::does: "debug", and the goals that a key may ask for.
const std::vector<std::string>& ChordActions();

// Throws ConfigError for keys or a word that do not exist; `where` begins what it says.
Chord MakeChord(const robot::ChordSpec& spec, const std::string& where);

// Finds chords in the keys as they are pressed. A chord is there when a key goes down and exactly
// its keys are down; one of two clicks when that happens twice within kDoubleClick. Where a chord
// has a variant of two clicks, both the first and the second click act.
class ChordReader {
 public:
  static constexpr double kDoubleClick = 0.5;  // s, *assumed*

  explicit ChordReader(std::vector<Chord> chords) : chords_(std::move(chords)) {}

  // The keys that are down at time t [s], not before the last call's t, while the state machine is
  // in `state`. Null when no chord came to be.
  const Chord* Read(std::uint16_t keys, int state, double t);

  // Whether the table holds a way into debug mode.
  bool knows_debug() const;

 private:
  std::vector<Chord> chords_;
  std::uint16_t down_ = 0;
  std::uint16_t last_ = 0;  // the chord of the last click
  double last_at_ = -kDoubleClick;
};

}  // namespace understudy::authority
