// The power sequence of a robot: which parts are up in each power state.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "robot/robot_spec.h"

namespace understudy::robot {

enum class PowerState : std::uint8_t { kOn, kBooting, kOff };

constexpr std::string_view Name(PowerState state) {
  constexpr std::array<std::string_view, 3> kNames = {"on", "booting", "off"};
  return kNames[static_cast<std::size_t>(state)];
}

// A robot that is on, booted, until it is switched. Times are simulated s and never go back.
class Power {
 public:
  // `spec` must outlive it.
  explicit Power(const BootSpec& spec) : spec_(spec) {}

  void SwitchOff() { state_ = PowerState::kOff; }
  // Begins to boot at t, unless it is on.
  void SwitchOn(double t) {
    if (state_ != PowerState::kOff) return;
    state_ = PowerState::kBooting;
    since_ = now_ = t;
  }
  // On and booted at once.
  void Skip() { state_ = PowerState::kOn; }

  // Goes on to t; returns whether the motion service must start now.
  bool Step(double t) {
    now_ = t;
    if (state_ != PowerState::kBooting || t - since_ < spec_.motion) return false;
    state_ = PowerState::kOn;
    return true;
  }

  PowerState state() const { return state_; }
  // When it was switched on; 0 before that.
  double since() const { return since_; }
  // Seconds until it has booted; 0 if it does not boot.
  double boots_for() const {
    return state_ == PowerState::kBooting ? std::max(spec_.motion - (now_ - since_), 0.0) : 0;
  }
  // Whether states are sent and commands heard.
  bool computes() const {
    return state_ == PowerState::kOn ||
           (state_ == PowerState::kBooting && now_ - since_ >= spec_.states);
  }
  // Whether the service answers that comes up as the `place`-th of `all`.
  bool answers(std::size_t place, std::size_t all) const {
    const double share =
        static_cast<double>(place) / static_cast<double>(std::max<std::size_t>(all, 1));
    return state_ == PowerState::kOn ||
           (state_ == PowerState::kBooting &&
            now_ - since_ >= spec_.services + share * (spec_.motion - spec_.services));
  }

 private:
  const BootSpec& spec_;
  PowerState state_ = PowerState::kOn;
  double since_ = 0;
  double now_ = 0;
};

}  // namespace understudy::robot
