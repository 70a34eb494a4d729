// How near a damage sheet has come to its limits.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "robot/damage.h"

namespace understudy::robot {

enum class DamageMark : std::uint8_t {
  kOk,
  kNear,    // at 80 % of the limit or more
  kBeyond,  // beyond the limit; of a time at a limit, any
};

// Returns "ok", "near" or "beyond".
std::string_view NameOf(DamageMark mark);

// What a figure of the sheet has reached.
struct DamageReached {
  double value = 0;    // of motors that of the one that is worst, measured by its limit
  std::string unit{};  // of `value`: s of a time at a limit, else that of the limit
  // In the unit of the limit, the worst motor's own where each has one; NaN: none is known.
  double limit = std::numeric_limits<double>::quiet_NaN();
  std::optional<std::size_t> motor{};  // the worst in motor order; nullopt while none has any
  DamageMark mark = DamageMark::kOk;
};

// Returns what the figure of a limit has reached. `motors` is in motor order, as sheet.motors.
DamageReached ReachedOf(const DamageLimit& limit, const DamageTotals& sheet,
                        const std::vector<MotorLimits>& motors);

// Returns the worst mark of the figures of one motor.
DamageMark WorstMark(const MotorDamage& motor, const MotorLimits& own,
                     const std::vector<DamageLimit>& limits);

// Returns whether each motor has a figure of that name.
bool IsOfMotors(std::string_view figure);

}  // namespace understudy::robot
