// State machines of motion services as tables: each row has the verdict on a goal in some states.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>

#include "authority/motion.h"

namespace understudy::motion {

// A set of states of an enum with at most 32 values.
template <class State>
class StateSet {
 public:
  constexpr StateSet(std::initializer_list<State> states) {
    for (const State state : states) bits_ |= Bit(state);
  }
  constexpr bool Has(State state) const { return (bits_ & Bit(state)) != 0; }

 private:
  static constexpr std::uint32_t Bit(State state) {
    return std::uint32_t{1} << static_cast<unsigned>(state);
  }
  std::uint32_t bits_ = 0;
};

// One row. `Wish` is the type of the goal's key, `When` an enum of conditions.
template <class Wish, class State, class When>
struct Transition {
  Wish wish;
  StateSet<State> from;
  When when;
  authority::MotionVerdict verdict;
  std::optional<State> to = {};  // next state for kTaken; nullopt: no change
};

// Returns the first row for that goal and state whose condition `holds`; null means kNotNow.
template <class Wish, class State, class When, class Holds>
const Transition<Wish, State, When>* Find(std::span<const Transition<Wish, State, When>> rows,
                                          const Wish& wish, State from, const Holds& holds) {
  for (const auto& row : rows) {
    if (row.wish == wish && row.from.Has(from) && holds(row.when)) return &row;
  }
  return nullptr;
}

}  // namespace understudy::motion
