// The one list of the tables in src/services/tables: the words of robot.apis, and what makes each.
#pragma once

#include <array>
#include <string_view>

// Calls row(name, expression that makes the table) for each, in the order of the documentation.
// Variants of a service share its topic and its api ids, so a robot has only one of them. A list
// for the preprocessor, so that what only needs the names is not linked with the tables.
// clang-format off
#define UNDERSTUDY_SERVICE_TABLES(row) \
  row("motion_switcher", MotionSwitcherTable()) \
  row("config", ConfigTable()) \
  row("robot_state_go2", RobotStateTable()) \
  row("robot_state", RobotStateLongTable()) \
  row("sport_go2", Go2SportTable("sport of Go2", kGo2Move)) \
  row("sport_go2_2024", OldGo2SportTable(kGo2Move)) \
  row("sport_go2w", Go2SportTable("sport of Go2-W", kGo2wMove)) \
  row("sport_b2", B2SportTable("sport of B2", 1.0)) \
  row("sport_b2w", B2SportTable("sport of B2-W", 0.5)) \
  row("sport_a2", A2SportTable()) \
  row("sport_g1", G1SportTable()) \
  row("loco_g1", G1LocoTable()) \
  row("sport_h2", H2SportTable()) \
  row("sport_r1", R1SportTable()) \
  row("loco_h1", H1LocoTable()) \
  row("arm_g1", G1ArmTable()) \
  row("obstacles_avoid", ObstaclesAvoidTable()) \
  row("vui", VuiTable()) \
  row("voice", VoiceTable()) \
  row("uwbswitch", UwbSwitchTable()) \
  row("videohub", VideoTable("videohub", "1.0.0.1")) \
  row("front_videohub", VideoTable("front_videohub", "1.0.0.0")) \
  row("back_videohub", VideoTable("back_videohub", "1.0.0.0"))
// clang-format on

namespace understudy::services {

#define UNDERSTUDY_NAME(name, make) std::string_view(name),
inline constexpr auto kApiNames =
    std::to_array<std::string_view>({UNDERSTUDY_SERVICE_TABLES(UNDERSTUDY_NAME)});
#undef UNDERSTUDY_NAME

}  // namespace understudy::services
