// The form of a motion service's state machine: rows that say what a wish comes to in a state.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>

#include "authority/motion.h"

namespace understudy::motion {

// Some of the states of an enum of at most 32.
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

// One row. `When` is an enum of conditions, `Wish` what the rows are found by.
template <class Wish, class State, class When>
struct Transition {
  Wish wish;
  StateSet<State> from;
  When when;
  authority::MotionVerdict verdict;
  std::optional<State> to = {};  // where kTaken leads; none: the state stays
};

// The first row of `rows` for that wish in that state whose condition `holds`. Null: the wish is
// not for now.
template <class Wish, class State, class When, class Holds>
const Transition<Wish, State, When>* Find(std::span<const Transition<Wish, State, When>> rows,
                                          const Wish& wish, State from, const Holds& holds) {
  for (const auto& row : rows) {
    if (row.wish == wish && row.from.Has(from) && holds(row.when)) return &row;
  }
  return nullptr;
}

}  // namespace understudy::motion
