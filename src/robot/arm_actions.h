// The arm actions of a G1, by id and name.
#pragma once

#include <array>
#include <string_view>
#include <utility>

namespace understudy::robot {

// Ids and names: [docs] G1 arm action interface; names of 13 and those of more than one word:
// unitree_sdk2_python g1_arm_action_client.
inline constexpr auto kArmActions =
    std::to_array<std::pair<int, std::string_view>>({{99, "release arm"},
                                                     {11, "two-hand kiss"},
                                                     {12, "left kiss"},
                                                     {13, "right kiss"},
                                                     {15, "hands up"},
                                                     {17, "clap"},
                                                     {18, "high five"},
                                                     {19, "hug"},
                                                     {20, "heart"},
                                                     {21, "right heart"},
                                                     {22, "reject"},
                                                     {23, "right hand up"},
                                                     {24, "x-ray"},
                                                     {25, "face wave"},
                                                     {26, "high wave"},
                                                     {27, "shake hand"}});

}  // namespace understudy::robot
