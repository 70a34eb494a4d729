// Declares the tables of the vendor's services. Sources in the rows: [sdk] a header of
// unitree_sdk2, commit 21d0a3b; [py] unitree_sdk2_python, commit 37116c5; [docs] the vendor's
// developer pages; [seen] on a real robot, by others (docs/sources.md); assumed. Private to
// services/.
#pragma once

#include "services/api_row.h"

namespace understudy::services {

// Limits [m/s, rad/s] to which the sport of Go2 and Go2-W clamps Move, and how long [s] one call
// holds.
struct MoveLimits {
  double vx_min, vx_max, vy, yaw_rate, hold;
};

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
ServiceTable VideoTable(std::string_view name, std::string_view title, std::string_view version);

}  // namespace understudy::services
