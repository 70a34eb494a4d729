// The words that robot.apis in a robot's YAML may have: the tables of src/services/tables by name.
#pragma once

#include <array>
#include <string_view>

namespace understudy::services {

// In the order of the documentation. Ids collide between variants of a service; a robot has one.
inline constexpr auto kApiNames = std::to_array<std::string_view>(
    {"motion_switcher", "config",     "robot_state_go2", "robot_state",
     "sport_go2",       "sport_go2w", "sport_b2",        "sport_b2w",
     "sport_a2",        "sport_g1",   "sport_h2",        "sport_r1",
     "loco_h1",         "arm_g1",     "obstacles_avoid", "vui",
     "voice",           "uwbswitch",  "videohub",        "front_videohub",
     "back_videohub"});

}  // namespace understudy::services
