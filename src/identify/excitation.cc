#include "identify/excitation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace understudy::identify {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;

// From 0 to 1 without a jump of speed.
double Eased(double share) {
  return (1 - std::cos(std::numbers::pi * std::clamp(share, 0.0, 1.0))) / 2;
}

}  // namespace

Excitation::Excitation(const robot::RobotSpec& robot, const ExcitationSpec& spec,
                       std::span<const double> q, std::span<const std::array<double, 2>> ranges)
    : spec_(spec) {
  for (std::size_t i = 0; i < robot.motors.size(); ++i) {
    const bool moves = spec.motors.empty() || std::ranges::count(spec.motors, i) > 0;
    const auto [low, high] = ranges[i];
    const double least = low + kMargin, most = high - kMargin;
    const double centre = least < most ? std::clamp(robot.hanging.q[i], least, most) : q[i];
    const double room = std::max(0.0, std::min(most - centre, centre - least));
    joints_.push_back({.begin = q[i],
                       .centre = centre,
                       .amplitude = moves ? std::min(spec.amplitude, room) : 0,
                       // Multiples of the golden section lie far apart.
                       .phase = kTurn * std::numbers::phi * static_cast<double>(i)});
  }
}

double Excitation::Angle(const Joint& joint, double t) const {
  if (t < kMove) return joint.begin + Eased(t / kMove) * (joint.centre - joint.begin);
  const double chirp = std::clamp(t - kMove, 0.0, spec_.seconds);
  const double ratio = std::log(spec_.to_hz / spec_.from_hz);
  const double growth = std::exp(ratio * chirp / spec_.seconds);
  const double turns = std::abs(ratio) > 1e-9 ? spec_.from_hz * spec_.seconds / ratio * (growth - 1)
                                              : spec_.from_hz * chirp;
  const double most = kMostSpeed / (kTurn * spec_.from_hz * growth);
  const double ramp = Eased(chirp / kRamp) * Eased((spec_.seconds - chirp) / kRamp);
  return joint.centre +
         ramp * std::min(joint.amplitude, most) * std::sin(kTurn * turns + joint.phase);
}

robot::RobotCommand Excitation::At(double t, double stopped) const {
  const double end = kMove + spec_.seconds;
  const double from = stopped >= 0 ? std::min(stopped, end) : end;
  const double hold = 1 - Eased((t - from) / kSoften);
  const double rise = Eased(t / kMove);  // of the gains, when it begins
  robot::RobotCommand command;
  for (const Joint& joint : joints_) {
    command.motors.push_back({.enabled = true,
                              .q = Angle(joint, std::min(t, from)),
                              .kp = spec_.kp * hold * std::min(1.0, 0.1 + rise),
                              .kd = spec_.kd});
  }
  return command;
}

}  // namespace understudy::identify
