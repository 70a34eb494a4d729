// The arm actions of a G1, by id and name.
#pragma once

#include <array>
#include <string_view>

namespace understudy::robot {

struct ArmActionName {
  int id = 0;
  std::string_view name;
  bool while_walking = false;  // in the states 500 and 501 only
};

// As a G1 with 29 motors and firmware 1.4.7 lists them (docs/dev/sources.md#arm-actions). Those of
// one with 23 are fewer: 20, 21, 28 to 30 and 36 need the waist and wrists that it lacks.
inline constexpr auto kArmActions =
    std::to_array<ArmActionName>({{99, "release_arm"},
                                  {1, "turn_back_wave", true},
                                  {11, "blow_kiss_with_both_hands"},
                                  {12, "blow_kiss_with_left_hand"},
                                  {13, "blow_kiss_with_right_hand"},
                                  {15, "both_hands_up"},
                                  {17, "clamp"},
                                  {18, "high_five"},
                                  {19, "hug"},
                                  {20, "make_heart_with_both_hands"},
                                  {21, "make_heart_with_right_hand"},
                                  {22, "refuse"},
                                  {23, "right_hand_up"},
                                  {24, "ultraman_ray"},
                                  {25, "wave_under_head"},
                                  {26, "wave_above_head"},
                                  {27, "shake_hand"},
                                  {28, "box_left_hand_win"},
                                  {29, "box_right_hand_win"},
                                  {30, "box_both_hand_win"},
                                  {33, "right_hand_on_heart"},
                                  {34, "both_hands_up_deviate_right"},
                                  {36, "forward_push"}});

}  // namespace understudy::robot
