// What the remote controller asks for and the robot does not do.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::authority {

struct Unheeded {
  enum class Reason : std::uint8_t {
    kNoMotionService,  // none is on
    kState,            // it is on, and does not do this in its present state
    kNotSimulated,     // a real robot would
  };
  Reason reason = Reason::kState;
  std::uint16_t keys = 0;  // of the chord; 0: the sticks
  int wish = -1;           // the vendor's id of the state that is asked for; -1: none
};

// Returns the word in events. Those of calls are the same.
constexpr std::string_view Name(Unheeded::Reason reason) {
  constexpr std::array<std::string_view, 3> kNames = {"no_motion_service", "state",
                                                      "not_simulated"};
  return kNames[static_cast<std::size_t>(reason)];
}

}  // namespace understudy::authority
