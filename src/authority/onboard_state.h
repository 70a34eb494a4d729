// Settings of the robot's computer that calls change: those of motion_switcher, robot_state and the
// motion service.
#pragma once

#include <cstdint>

namespace understudy::authority {

// The reports on the robot's programs that robot_state publishes by itself.
struct ProgramReport {
  int interval = 0;         // s; 0: none
  int duration = 0;         // s; 0: for good
  std::uint64_t asked = 0;  // number of requests for reports
};

struct OnboardState {
  bool silent = false;  // motion_switcher starts no motion service at boot
  // rt/user_lowcmd moves the motors while the service is on (G1, loco api 7110 and 7111).
  bool user_control = false;
  bool sticks = true;   // the sticks of the remote controller move the robot (SwitchJoystick)
  bool avoids = false;  // the switch of obstacles_avoid
  ProgramReport report{};

  // Replaces the reports requested before; arguments in s, as in ProgramReport.
  void RequestReport(int interval, int duration) {
    report = {.interval = interval, .duration = duration, .asked = report.asked + 1};
  }

  // Resets what ends with the motion service. That a restart turns the sticks on is *assumed*.
  void EndMotionService() {
    user_control = false;
    sticks = true;
  }
};

}  // namespace understudy::authority
