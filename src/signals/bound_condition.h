// Conditions over the signals that they name.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "base/result.h"
#include "judge/formula.h"
#include "signals/signals.h"

namespace understudy::signals {

// A comparison of a formula, by its number there.
struct LeafText {
  std::string text;        // "base.tilt < 30 deg"
  std::string unit{};      // of its margin, "" if it has none
  bool is_number = false;  // asks whether the signal is this very number
  std::size_t signal = 0;  // its place among the signals
  judge::Leaf leaf{};
};

struct BoundCondition {
  judge::Formula formula{};  // without operators that look ahead
  std::vector<LeafText> leaves{};
};

// Reads a condition and finds its signals, which it adds to `signals` unless they are there. An
// Error has what was expected and the nearest word.
Result<BoundCondition> BindCondition(std::string_view text, const Names& names,
                                     std::vector<Signal>* signals);

}  // namespace understudy::signals
