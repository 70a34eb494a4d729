// Lists the valid words of robot.apis: the names of the tables in src/services/tables.
#pragma once

#include <array>
#include <string_view>

namespace understudy::services {

// In the order of the documentation. Variants of a service share api ids, so a robot has only one.
inline constexpr auto kApiNames = std::to_array<std::string_view>(
    {"motion_switcher", "config",     "robot_state_go2", "robot_state",
     "sport_go2",       "sport_go2w", "sport_b2",        "sport_b2w",
     "sport_a2",        "sport_g1",   "sport_h2",        "sport_r1",
     "loco_h1",         "arm_g1",     "obstacles_avoid", "vui",
     "voice",           "uwbswitch",  "videohub",        "front_videohub",
     "back_videohub"});

}  // namespace understudy::services
