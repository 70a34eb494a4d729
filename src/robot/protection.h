// What a motion service watches for by itself, and what it does about it: rules and readings.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace understudy::robot {

// What can endanger a robot. Each has a rule in ProtectionSpec and a row in
// motion/protection.cc, in this order.
enum class Danger : std::uint8_t {
  kTilt,
  kOverspeed,
  kJointEnd,
  kHeat,
  kCharge,
  kMotor,
  kRemote,
};

inline constexpr std::size_t kDangers = 7;

// What a motion service does about a danger, from mild to strong.
enum class Protection : std::uint8_t {
  kNothing,  // it does not watch for it
  kWarn,     // tells it
  kStop,     // tells it and stands still
  kLieDown,  // tells it and lies down; what cannot lie down only tells it
  kDamp,     // tells it and damps all motors
};

constexpr std::string_view Name(Protection protection) {
  constexpr std::array<std::string_view, 5> kNames = {"nothing", "warn", "stop", "lie_down",
                                                      "damp"};
  return kNames[static_cast<std::size_t>(protection)];
}

struct ProtectionRule {
  Protection does = Protection::kNothing;
  double limit = 0;  // of the danger's measure, in its unit
  double time = 0;   // s that the measure has to be beyond the limit
};

// All *assumed*; docs/reference/fidelity.md says what is known of each.
struct ProtectionSpec {
  ProtectionRule tilt{Protection::kDamp, 1.2, 0};
  ProtectionRule overspeed{Protection::kWarn, 1.5, 0.02};
  ProtectionRule joint_end{Protection::kWarn, 0.1, 0.1};
  ProtectionRule heat{Protection::kLieDown, 110, 1};
  ProtectionRule charge{Protection::kStop, 0, 0.1};
  ProtectionRule motor{Protection::kDamp, 0, 0.2};
  ProtectionRule remote{Protection::kStop, 0, 0.1};
};

// A danger as it stands.
struct DangerReading {
  double value = 0;                        // its measure
  std::int16_t motor = -1;                 // in motor order, of which it is; -1: of none
  Protection does = Protection::kNothing;  // since it was beyond its limit; nothing: it is not
};

}  // namespace understudy::robot
