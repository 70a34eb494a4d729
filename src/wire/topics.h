// The topics of a robot's low level, as the vendor names them (hardware_contract: basic services).
#ifndef UNDERSTUDY_WIRE_TOPICS_H_
#define UNDERSTUDY_WIRE_TOPICS_H_

#include "bus/topic.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy {

inline constexpr Topic<unitree_go_msg_dds__LowCmd_> kGoLowCmd{"rt/lowcmd",
                                                              &unitree_go_msg_dds__LowCmd__desc};
inline constexpr Topic<unitree_go_msg_dds__LowState_> kGoLowState{
    "rt/lowstate", &unitree_go_msg_dds__LowState__desc};
inline constexpr Topic<unitree_go_msg_dds__LowState_> kGoLfLowState{
    "rt/lf/lowstate", &unitree_go_msg_dds__LowState__desc};

inline constexpr Topic<unitree_hg_msg_dds__LowCmd_> kHgLowCmd{"rt/lowcmd",
                                                              &unitree_hg_msg_dds__LowCmd__desc};
inline constexpr Topic<unitree_hg_msg_dds__LowState_> kHgLowState{
    "rt/lowstate", &unitree_hg_msg_dds__LowState__desc};
inline constexpr Topic<unitree_hg_msg_dds__LowState_> kHgLfLowState{
    "rt/lf/lowstate", &unitree_hg_msg_dds__LowState__desc};
inline constexpr Topic<unitree_hg_msg_dds__IMUState_> kSecondaryImu{
    "rt/secondary_imu", &unitree_hg_msg_dds__IMUState__desc};
inline constexpr Topic<unitree_hg_msg_dds__IMUState_> kLfSecondaryImu{
    "rt/lf/secondary_imu", &unitree_hg_msg_dds__IMUState__desc};
inline constexpr Topic<unitree_hg_msg_dds__BmsState_> kLfBmsState{
    "rt/lf/bmsstate", &unitree_hg_msg_dds__BmsState__desc};

// Where the base is: quadrupeds call it sport mode, humanoids odometry; both in the go type.
inline constexpr Topic<unitree_go_msg_dds__SportModeState_> kSportModeState{
    "rt/sportmodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr Topic<unitree_go_msg_dds__SportModeState_> kLfSportModeState{
    "rt/lf/sportmodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr Topic<unitree_go_msg_dds__SportModeState_> kOdomModeState{
    "rt/odommodestate", &unitree_go_msg_dds__SportModeState__desc};
inline constexpr Topic<unitree_go_msg_dds__SportModeState_> kLfOdomModeState{
    "rt/lf/odommodestate", &unitree_go_msg_dds__SportModeState__desc};

}  // namespace understudy

#endif  // UNDERSTUDY_WIRE_TOPICS_H_
