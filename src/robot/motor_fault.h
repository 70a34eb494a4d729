// What can be wrong with a motor, of the body or of a hand, whatever it is told to do.
#pragma once

#include <algorithm>
#include <array>
#include <string_view>

namespace understudy::robot {

// A fault by what it does. What is no more than a share of the torque or a joint that does not turn
// is a row; another law goes where these two are read, MotorBank::Step and Robot::SetFault.
struct MotorFault {
  std::string_view name;    // in requests and events
  double torque_share = 1;  // of the torque that the motor would give
  bool jams = false;        // the joint does not turn (physics::RobotBody::Jam)
};

// The first one is none.
inline constexpr auto kMotorFaults = std::to_array<MotorFault>({
    {"none"},
    {"limp", 0},        // no torque, as of a drive without current
    {"stuck", 1, true}  // a seized gear: the motor goes on pushing and gets warm
});

inline constexpr auto kMotorFaultNames = [] {
  std::array<std::string_view, kMotorFaults.size()> names{};
  std::ranges::transform(kMotorFaults, names.begin(), &MotorFault::name);
  return names;
}();

}  // namespace understudy::robot
