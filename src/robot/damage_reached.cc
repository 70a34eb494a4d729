#include "robot/damage_reached.h"

#include <algorithm>
#include <array>
#include <utility>

namespace understudy::robot {
namespace {

constexpr double kNear = 0.8;  // of a limit; *assumed*

// A figure of the motors.
struct MotorFigure {
  std::string_view name;
  double MotorDamage::*value;
  const char* unit;
  bool counts = false;                 // it is a time at a limit
  double MotorLimits::*own = nullptr;  // each motor's limit; null: one for all
};

constexpr MotorFigure kMotorFigures[] = {
    {"at_torque_limit", &MotorDamage::at_torque_limit, "s", true, &MotorLimits::torque},
    {"at_speed_limit", &MotorDamage::at_speed_limit, "s", true, &MotorLimits::speed},
    {"tripped", &MotorDamage::tripped, "s", true},
    {"hottest", &MotorDamage::hottest_c, "°C"},
    {"hardest_stop", &MotorDamage::hardest_stop, "rad/s"},
    {"largest_jump", &MotorDamage::largest_jump, "rad", false, &MotorLimits::jump},
};

const MotorFigure* FindFigure(std::string_view name) {
  const auto* const found = std::ranges::find(kMotorFigures, name, &MotorFigure::name);
  return found == std::end(kMotorFigures) ? nullptr : found;
}

// 0 is a limit that is not known, except where `zero_counts`.
DamageMark MarkOf(double value, double limit, bool zero_counts) {
  if (zero_counts ? value > limit : limit > 0 && value > limit) return DamageMark::kBeyond;
  return limit > 0 && value >= kNear * limit ? DamageMark::kNear : DamageMark::kOk;
}

DamageMark MarkOf(const MotorFigure& figure, double value, double limit) {
  return figure.counts ? MarkOf(value, 0, true) : MarkOf(value, limit, false);
}

// A motor's own limit, or that of all.
double LimitOf(const MotorFigure& figure, const MotorLimits& own, const DamageLimit& all) {
  return figure.own != nullptr ? own.*figure.own : all.limit;
}

DamageReached ReachedByMotors(const MotorFigure& figure, const DamageLimit& limit,
                              const DamageTotals& sheet, const std::vector<MotorLimits>& motors) {
  DamageReached reached{.unit = figure.unit};
  if (figure.own == nullptr) reached.limit = limit.limit;
  std::pair<double, double> worst{0, 0};  // share of the limit, value
  for (std::size_t i = 0; i < sheet.motors.size(); ++i) {
    const double value = sheet.motors[i].*figure.value;
    const double most = LimitOf(figure, motors[i], limit);
    const std::pair<double, double> one{!figure.counts && most > 0 ? value / most : 0, value};
    if (one <= worst) continue;
    worst = one;
    reached.value = value;
    reached.motor = i;
    if (most > 0) reached.limit = most;
    reached.mark = MarkOf(figure, value, most);
  }
  return reached;
}

}  // namespace

std::string_view NameOf(DamageMark mark) {
  constexpr std::array<std::string_view, 3> kNames = {"ok", "near", "beyond"};
  return kNames[static_cast<std::size_t>(mark)];
}

bool IsOfMotors(std::string_view figure) { return FindFigure(figure) != nullptr; }

DamageReached ReachedOf(const DamageLimit& limit, const DamageTotals& sheet,
                        const std::vector<MotorLimits>& motors) {
  if (const MotorFigure* const figure = FindFigure(limit.figure)) {
    return ReachedByMotors(*figure, limit, sheet, motors);
  }
  const std::pair<std::string_view, double> values[] = {
      {"energy", sheet.energy}, {"peak_current", sheet.peak_current},
      {"shock", sheet.shock},   {"worst_tilt", sheet.worst_tilt},
      {"falls", sheet.falls},
  };
  const auto* const found =
      std::ranges::find(values, limit.figure, &std::pair<std::string_view, double>::first);
  if (found == std::end(values)) return {};
  return {.value = found->second,
          .unit = limit.unit,
          .limit = limit.limit,
          .mark = MarkOf(found->second, limit.limit, true)};
}

DamageMark WorstMark(const MotorDamage& motor, const MotorLimits& own,
                     const std::vector<DamageLimit>& limits) {
  DamageMark worst = DamageMark::kOk;
  for (const DamageLimit& limit : limits) {
    const MotorFigure* const figure = FindFigure(limit.figure);
    if (figure == nullptr) continue;
    const double most = LimitOf(*figure, own, limit);
    worst = std::max(worst, MarkOf(*figure, motor.*(figure->value), most));
  }
  return worst;
}

}  // namespace understudy::robot
