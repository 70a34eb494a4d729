// The topics of a robot's low level, as the vendor names them (docs/sources.md#topics).
#pragma once

#include "bus/topic.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::wire {

inline constexpr bus::Topic<unitree_go_msg_dds__LowCmd_> kGoLowCmd{
    "rt/lowcmd", &unitree_go_msg_dds__LowCmd__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__LowState_> kGoLowState{
    "rt/lowstate", &unitree_go_msg_dds__LowState__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__LowState_> kGoLfLowState{
    "rt/lf/lowstate", &unitree_go_msg_dds__LowState__desc};

inline constexpr bus::Topic<unitree_hg_msg_dds__LowCmd_> kHgLowCmd{
    "rt/lowcmd", &unitree_hg_msg_dds__LowCmd__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__LowState_> kHgLowState{
    "rt/lowstate", &unitree_hg_msg_dds__LowState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__LowState_> kHgLfLowState{
    "rt/lf/lowstate", &unitree_hg_msg_dds__LowState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__IMUState_> kSecondaryImu{
    "rt/secondary_imu", &unitree_hg_msg_dds__IMUState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__IMUState_> kLfSecondaryImu{
    "rt/lf/secondary_imu", &unitree_hg_msg_dds__IMUState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__BmsState_> kLfBmsState{
    "rt/lf/bmsstate", &unitree_hg_msg_dds__BmsState__desc};

// Where the base is: quadrupeds call it sport mode, humanoids odometry; both in the go type.
inline constexpr bus::Topic<unitree_go_msg_dds__SportModeState_> kSportModeState{
    "rt/sportmodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__SportModeState_> kLfSportModeState{
    "rt/lf/sportmodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__SportModeState_> kOdomModeState{
    "rt/odommodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__SportModeState_> kLfOdomModeState{
    "rt/lf/odommodestate", &unitree_go_msg_dds__SportModeState__desc};

// What programs mix over the motion service's commands, and what it can leave the motors to.
inline constexpr bus::Topic<unitree_go_msg_dds__LowCmd_> kGoArmSdk{
    "rt/arm_sdk", &unitree_go_msg_dds__LowCmd__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__LowCmd_> kHgArmSdk{
    "rt/arm_sdk", &unitree_hg_msg_dds__LowCmd__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__LowCmd_> kUserLowCmd{
    "rt/user_lowcmd", &unitree_hg_msg_dds__LowCmd__desc};

// The same name as the go family's, in a type of its own.
inline constexpr bus::Topic<unitree_hg_msg_dds__SportModeState_> kHgSportModeState{
    "rt/sportmodestate", &unitree_hg_msg_dds__SportModeState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__SportModeState_> kLfHgSportModeState{
    "rt/lf/sportmodestate", &unitree_hg_msg_dds__SportModeState__desc};
inline constexpr bus::Topic<unitree_hg_msg_dds__MainBoardState_> kLfMainBoardState{
    "rt/lf/mainboardstate", &unitree_hg_msg_dds__MainBoardState__desc};
inline constexpr bus::Topic<std_msgs_msg_dds__String_> kArmActionState{
    "rt/arm/action/state", &std_msgs_msg_dds__String__desc};
inline constexpr bus::Topic<std_msgs_msg_dds__String_> kErrorList{"rt/errorlist",
                                                                  &std_msgs_msg_dds__String__desc};
inline constexpr bus::Topic<unitree_go_msg_dds__WirelessController_> kWirelessController{
    "rt/wirelesscontroller", &unitree_go_msg_dds__WirelessController__desc};

}  // namespace understudy::wire
