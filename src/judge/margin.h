// The robustness of a claim: by how much it holds or fails.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

namespace understudy::judge {

// Simulated time, or that of a recording [ns since its start].
using Time = std::int64_t;

// A margin is not negative where the claim holds: its sign bit is the truth value, so that -0.0 is
// a claim that fails by nothing (x < 5 at 5) and 0.0 one that just holds (x <= 5 at 5). A claim
// without a quantity, such as an event, holds or fails by infinity. NaN: nothing is known.
inline bool Holds(double margin) { return !std::signbit(margin); }
inline bool IsKnown(double margin) { return !std::isnan(margin); }

// Orders known margins, with -0.0 below 0.0.
inline bool IsLess(double a, double b) {
  return a < b || (a == b && std::signbit(a) && !std::signbit(b));
}

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
inline constexpr double kNoQuantity = std::numeric_limits<double>::infinity();

// A margin and what gave it.
struct Worth {
  double margin = kUnknown;
  Time at = 0;           // the instant
  std::size_t leaf = 0;  // the comparison, by its number in the formula
  double value = 0;      // of the signal, in the unit of the comparison

  bool known() const { return IsKnown(margin); }
  bool holds() const { return Holds(margin); }
};

// Return the one with the smaller and with the larger margin, the first of equals. Unknown if one
// of them is.
inline const Worth& Least(const Worth& a, const Worth& b) {
  if (!a.known()) return a;
  return !b.known() || IsLess(b.margin, a.margin) ? b : a;
}
inline const Worth& Most(const Worth& a, const Worth& b) {
  if (!a.known()) return a;
  return !b.known() || IsLess(a.margin, b.margin) ? b : a;
}

}  // namespace understudy::judge
