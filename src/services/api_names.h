// The one list of the tables in src/services/tables: the words of robot.apis, and what makes each.
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// Calls row(name, service, expression that makes the table) for each, in the order of the
// documentation. Variants of a service share its topic and its api ids, so a robot has only one of
// them. A list for the preprocessor, so that what only needs the names is not linked with the
// tables.
// clang-format off
#define UNDERSTUDY_SERVICE_TABLES(row) \
  row("motion_switcher", "motion_switcher", MotionSwitcherTable()) \
  row("config", "config", ConfigTable()) \
  row("robot_state_go2", "robot_state", RobotStateTable()) \
  row("robot_state", "robot_state", RobotStateLongTable()) \
  row("sport_go2", "sport", Go2SportTable("sport of Go2", kGo2Move)) \
  row("sport_go2_2024", "sport", OldGo2SportTable(kGo2Move)) \
  row("sport_go2w", "sport", Go2SportTable("sport of Go2-W", kGo2wMove)) \
  row("sport_b2", "sport", B2SportTable("sport of B2", 1.0)) \
  row("sport_b2w", "sport", B2SportTable("sport of B2-W", 0.5)) \
  row("sport_a2", "sport", A2SportTable()) \
  row("sport_g1", "sport", G1SportTable()) \
  row("loco_g1", "loco", G1LocoTable()) \
  row("sport_h2", "sport", H2SportTable()) \
  row("sport_r1", "sport", R1SportTable()) \
  row("loco_h1", "loco", H1LocoTable()) \
  row("arm_g1", "arm", G1ArmTable()) \
  row("obstacles_avoid", "obstacles_avoid", ObstaclesAvoidTable()) \
  row("vui", "vui", VuiTable()) \
  row("voice", "voice", VoiceTable()) \
  row("uwbswitch", "uwbswitch", UwbSwitchTable()) \
  row("videohub", "videohub", VideoTable("videohub", "1.0.0.1")) \
  row("front_videohub", "front_videohub", VideoTable("front_videohub", "1.0.0.0")) \
  row("back_videohub", "back_videohub", VideoTable("back_videohub", "1.0.0.0"))
// clang-format on

namespace understudy::services {

#define UNDERSTUDY_NAME(name, service, make) std::string_view(name),
inline constexpr auto kApiNames =
    std::to_array<std::string_view>({UNDERSTUDY_SERVICE_TABLES(UNDERSTUDY_NAME)});
#undef UNDERSTUDY_NAME

// Returns the names of the services behind these words, as in rt/api/<service>/request, in the same
// order; unknown words are left out.
inline std::vector<std::string> ServiceNames(const std::vector<std::string>& apis) {
#define UNDERSTUDY_SERVICE(name, service, make) \
  std::pair<std::string_view, std::string_view>(name, service),
  static constexpr auto kServices = std::to_array({UNDERSTUDY_SERVICE_TABLES(UNDERSTUDY_SERVICE)});
#undef UNDERSTUDY_SERVICE
  std::vector<std::string> services;
  for (const std::string& api : apis) {
    for (const auto& [name, service] : kServices) {
      if (name == api) services.emplace_back(service);
    }
  }
  return services;
}

}  // namespace understudy::services
