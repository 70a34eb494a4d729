// Finds chords in the keys of the remote controller and makes goals of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motion.h"
#include "robot/robot_spec.h"

namespace understudy::authority {

// A chord of the robot's description, decoded.
struct Chord {
  std::uint16_t keys = 0;
  int clicks = 1;
  std::optional<MotionGoal> goal;  // nullopt: releases the motion service (debug mode)
  std::vector<int> from;           // ids of the states in which it works; empty = all
};

// Returns the valid words of ChordSpec::does: "debug" and the names of goals.
const std::vector<std::string>& ChordActions();

// Decodes a chord. Throws ConfigError, beginning with `where`, for unknown keys or an unknown word.
Chord MakeChord(const robot::ChordSpec& spec, const std::string& where);

// Detects chords. A chord occurs when a key goes down and then exactly its keys are down; a chord
// of two clicks when that happens twice within kDoubleClick. If the same keys have chords of one
// and of two clicks, the first click triggers one and the second the other.
class ChordReader {
 public:
  static constexpr double kDoubleClick = 0.5;  // s, *assumed*

  explicit ChordReader(std::vector<Chord> chords) : chords_(std::move(chords)) {}

  // Takes the keys that are down at time t [s], which must not go back, and the id of the present
  // state. Returns the chord that occurred, or null.
  const Chord* Read(std::uint16_t keys, int state, double t);
  // Returns the chord that the last Read would have returned in another state, or null.
  const Chord* missed() const { return missed_; }

  // Returns whether a chord leads to debug mode.
  bool knows_debug() const;

 private:
  std::vector<Chord> chords_;
  const Chord* missed_ = nullptr;
  std::uint16_t down_ = 0;
  std::uint16_t last_ = 0;  // the chord of the last click
  double last_at_ = -kDoubleClick;
};

}  // namespace understudy::authority
