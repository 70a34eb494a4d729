#include "judge/formula.h"

#include <algorithm>
#include <cmath>

namespace understudy::judge {
namespace {

// A margin of 0 holds or fails as the comparison says.
double Strict(double margin) { return margin == 0 ? -0.0 : margin; }
double Inclusive(double margin) { return margin == 0 ? 0.0 : margin; }
double Truth(bool holds) { return holds ? kNoQuantity : -kNoQuantity; }

std::size_t NumberFrom(Formula* formula, std::size_t next) {
  if (formula->op == Op::kLeaf) {
    formula->leaf.number = next;
    return next + 1;
  }
  for (Formula& part : formula->parts) next = NumberFrom(&part, next);
  return next;
}

}  // namespace

double MarginOf(const Leaf& leaf, double signal) {
  if (std::isnan(signal)) return leaf.fails_unsaid ? -kNoQuantity : kUnknown;
  const double value = signal * leaf.scale;
  switch (leaf.compare) {
    case Compare::kBelow:
      return Strict(leaf.value - value);
    case Compare::kAtMost:
      return Inclusive(leaf.value - value);
    case Compare::kAbove:
      return Strict(value - leaf.value);
    case Compare::kAtLeast:
      return Inclusive(value - leaf.value);
    case Compare::kNear:
      return Inclusive(leaf.tolerance - std::abs(value - leaf.value));
    case Compare::kEqual:
      return Truth(value == leaf.value);
    case Compare::kTrue:
      return Truth(signal > 0);
  }
  return kUnknown;
}

double MarginOf(const Formula& formula, std::span<const double> signals) {
  switch (formula.op) {
    case Op::kLeaf:
      return MarginOf(formula.leaf, signals[formula.leaf.signal]);
    case Op::kNot:
      return -MarginOf(formula.parts.front(), signals);
    case Op::kAll:
    case Op::kAny: {
      Worth worth{.margin = MarginOf(formula.parts.front(), signals)};
      for (std::size_t i = 1; i < formula.parts.size(); ++i) {
        const Worth part{.margin = MarginOf(formula.parts[i], signals)};
        worth = formula.op == Op::kAll ? Least(worth, part) : Most(worth, part);
      }
      return worth.margin;
    }
    case Op::kAlways:
    case Op::kEventually:
      break;
  }
  return kUnknown;
}

std::size_t NumberLeaves(Formula* formula) { return NumberFrom(formula, 0); }

Time Horizon(const Formula& formula) {
  Time most = 0;
  for (const Formula& part : formula.parts) most = std::max(most, Horizon(part));
  return most + formula.to;
}

}  // namespace understudy::judge
