#include "services/robot_services.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <utility>

#include "base/errors.h"
#include "services/api_names.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

// Velocities: [docs] Go2 motion services V2.0; Go2-W high-level motion services, default gait.
constexpr MoveLimits kGo2Move{
    .vx_min = -2.5, .vx_max = 3.8, .vy = 1.0, .yaw_rate = 4.0, .hold = 1.0};
constexpr MoveLimits kGo2wMove{
    .vx_min = -1.5, .vx_max = 1.5, .vy = 0.6, .yaw_rate = 1.0, .hold = 1.0};

struct NamedTable {
  std::string_view name;
  ServiceTable (*make)();
};

constexpr NamedTable kTables[] = {
    {"motion_switcher", &MotionSwitcherTable},
    {"config", &ConfigTable},
    {"robot_state_go2", &RobotStateTable},
    {"robot_state", &RobotStateLongTable},
    {"sport_go2", [] { return Go2SportTable("sport of Go2", kGo2Move); }},
    {"sport_go2w", [] { return Go2SportTable("sport of Go2-W", kGo2wMove); }},
    {"sport_b2", [] { return B2SportTable("sport of B2", 1.0); }},
    {"sport_b2w", [] { return B2SportTable("sport of B2-W", 0.5); }},
    {"sport_a2", &A2SportTable},
    {"sport_g1", &G1SportTable},
    {"sport_h2", &H2SportTable},
    {"sport_r1", &R1SportTable},
    {"loco_h1", &H1LocoTable},
    {"arm_g1", &G1ArmTable},
    {"obstacles_avoid", &ObstaclesAvoidTable},
    {"vui", &VuiTable},
    {"voice", &VoiceTable},
    {"uwbswitch", &UwbSwitchTable},
    {"videohub", [] { return VideoTable("videohub", "videohub of Go2, Go2-W", "1.0.0.1"); }},
    {"front_videohub",
     [] { return VideoTable("front_videohub", "front_videohub of B2, B2-W", "1.0.0.0"); }},
    {"back_videohub",
     [] { return VideoTable("back_videohub", "back_videohub of B2, B2-W", "1.0.0.0"); }},
};
static_assert(std::ranges::equal(kTables, kApiNames, {}, &NamedTable::name));

}  // namespace

ServiceTable TableNamed(std::string_view name) {
  const auto* found = std::ranges::find(kTables, name, &NamedTable::name);
  if (found == std::end(kTables)) throw std::out_of_range("no api '" + std::string(name) + "'");
  return found->make();
}

std::vector<ServiceTable> ServicesOf(const std::vector<std::string>& apis) {
  std::vector<ServiceTable> tables;
  for (const std::string& api : apis) {
    ServiceTable table = TableNamed(api);
    if (std::ranges::count(tables, table.name, &ServiceTable::name) != 0) {
      throw ConfigError("robot.apis: a robot has only one service '" + std::string(table.name) +
                        "'; '" + api + "' is a second one");
    }
    tables.push_back(std::move(table));
  }
  return tables;
}

}  // namespace understudy::services
