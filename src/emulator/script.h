// What a script asks of a world, and when.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

#include "emulator/request.h"

namespace understudy::emulator {

// A request that a script makes.
struct ScriptEvent {
  // Simulated s from the start; with `after` from the end of the event before it.
  double at = 0;
  Request request{};
  std::string where{};  // "stand.yaml:3"
  // Whether the event follows the one before it in the list, even if that one failed.
  bool after = false;
  // The number of the condition for which it waits from then on; nullopt: it is made at once.
  std::optional<std::size_t> when{};
  std::string condition{};                                  // that one in words
  double within = std::numeric_limits<double>::infinity();  // s that it waits at most
};

// The conditions of a script, by number.
class ScriptConditions {
 public:
  virtual ~ScriptConditions() = default;

  // Takes what has happened since the last call. The world calls it at the start of each tick,
  // until the script is over; with `measure` something waits, and the values of this instant are
  // needed. Must not allocate.
  virtual void Look(const World& world, bool measure) = 0;
  // Returns whether a condition held at that instant, which was measured.
  virtual bool Holds(std::size_t condition) const = 0;
};

}  // namespace understudy::emulator
