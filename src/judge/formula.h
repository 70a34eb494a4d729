// Formulas of signal temporal logic over sampled signals.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "judge/margin.h"

namespace understudy::judge {

enum class Compare : std::uint8_t {
  kBelow,    // value - signal
  kAtMost,   // value - signal
  kAbove,    // signal - value
  kAtLeast,  // signal - value
  kNear,     // tolerance - |signal - value|
  kEqual,    // without a quantity
  kTrue,     // the signal is above 0; without a quantity
};

// A comparison of one signal. Its margin has the unit of `value`.
struct Leaf {
  std::size_t signal = 0;  // its place among the values of a sample
  Compare compare = Compare::kAtLeast;
  double value = 0;
  double tolerance = 0;       // of kNear
  double scale = 1;           // the signal's unit in that of `value`
  bool fails_unsaid = false;  // while the signal is NaN it fails; else nothing is known
  std::size_t number = 0;     // of the leaf in the formula, as Worth::leaf
};

// Returns the margin of a comparison (Donzé and Maler 2010) for a value of its signal.
double MarginOf(const Leaf& leaf, double signal);

enum class Op : std::uint8_t { kLeaf, kNot, kAll, kAny, kAlways, kEventually };

// A formula with one margin at each instant. The two last look ahead, from `from` to `to` later,
// inclusive.
struct Formula {
  Op op = Op::kLeaf;
  Leaf leaf{};                   // of kLeaf
  std::vector<Formula> parts{};  // one; of kAll and kAny one or more
  Time from = 0, to = 0;         // of kAlways and kEventually; 0 <= from <= to
};

// Returns the margin of a formula at an instant with these signals; unknown where it looks ahead.
// Allocates nothing.
double MarginOf(const Formula& formula, std::span<const double> signals);

// Numbers the leaves from 0, in order. Returns their count.
std::size_t NumberLeaves(Formula* formula);

// Returns how far beyond an instant the formula looks.
Time Horizon(const Formula& formula);

}  // namespace understudy::judge
