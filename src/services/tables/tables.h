// Declares the tables of the vendor's services. Sources in the rows: [sdk] a header of
// unitree_sdk2, commit 21d0a3b; [py] unitree_sdk2_python, commit 37116c5; [docs] the vendor's
// developer pages; [seen] on a real robot, by others (docs/dev/sources.md); assumed. Private to
// services/.
#pragma once

#include "services/api_row.h"

namespace understudy::services {

// Limits [m/s, rad/s] to which the sport of Go2 and Go2-W clamps Move, and how long [s] one call
// holds.
struct MoveLimits {
  double vx_min, vx_max, vy, yaw_rate, hold;
};
// Velocities: [docs] Go2 motion services V2.0; Go2-W high-level motion services, default gait.
inline constexpr MoveLimits kGo2Move{
    .vx_min = -2.5, .vx_max = 3.8, .vy = 1.0, .yaw_rate = 4.0, .hold = 1.0};
inline constexpr MoveLimits kGo2wMove{
    .vx_min = -1.5, .vx_max = 1.5, .vy = 0.6, .yaw_rate = 1.0, .hold = 1.0};

ServiceTable MotionSwitcherTable();
ServiceTable RobotStateTable();      // three calls, version 1.0.0.1
ServiceTable RobotStateLongTable();  // six calls, version 1.0.0.2
ServiceTable ConfigTable();

ServiceTable Go2SportTable(std::string_view title, const MoveLimits& limits);
ServiceTable OldGo2SportTable(const MoveLimits& limits);  // before firmware 1.1.6
ServiceTable B2SportTable(std::string_view title, double hold);
ServiceTable A2SportTable();

ServiceTable G1SportTable();
ServiceTable G1LocoTable();  // before firmware 1.4
ServiceTable H2SportTable();
ServiceTable R1SportTable();
ServiceTable H1LocoTable();
ServiceTable G1ArmTable();

ServiceTable ObstaclesAvoidTable();
ServiceTable VuiTable();
ServiceTable VoiceTable();
ServiceTable UwbSwitchTable();
ServiceTable VideoTable(std::string_view name, std::string_view version);

}  // namespace understudy::services
