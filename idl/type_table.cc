#include "idl/type_table.h"

#include <algorithm>
#include <array>

#include "idl/builtin_interfaces.h"
#include "idl/geometry_msgs.h"
#include "idl/hello_world.h"
#include "idl/inspire.h"
#include "idl/nav_msgs.h"
#include "idl/sensor_msgs.h"
#include "idl/std_msgs.h"
#include "idl/unitree_api.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"
#include "idl/unitree_hg_doubleimu.h"

namespace understudy {
namespace {

constexpr auto kMessageTypes = std::to_array<MessageType>({
    {"HelloWorldData::Msg", &HelloWorldData_Msg_desc},
    {"builtin_interfaces::msg::dds_::Time_", &builtin_interfaces_msg_dds__Time__desc},
    {"geometry_msgs::msg::dds_::Point32_", &geometry_msgs_msg_dds__Point32__desc},
    {"geometry_msgs::msg::dds_::PointStamped_", &geometry_msgs_msg_dds__PointStamped__desc},
    {"geometry_msgs::msg::dds_::Point_", &geometry_msgs_msg_dds__Point__desc},
    {"geometry_msgs::msg::dds_::Pose2D_", &geometry_msgs_msg_dds__Pose2D__desc},
    {"geometry_msgs::msg::dds_::PoseStamped_", &geometry_msgs_msg_dds__PoseStamped__desc},
    {"geometry_msgs::msg::dds_::PoseWithCovarianceStamped_",
     &geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc},
    {"geometry_msgs::msg::dds_::PoseWithCovariance_",
     &geometry_msgs_msg_dds__PoseWithCovariance__desc},
    {"geometry_msgs::msg::dds_::Pose_", &geometry_msgs_msg_dds__Pose__desc},
    {"geometry_msgs::msg::dds_::QuaternionStamped_",
     &geometry_msgs_msg_dds__QuaternionStamped__desc},
    {"geometry_msgs::msg::dds_::Quaternion_", &geometry_msgs_msg_dds__Quaternion__desc},
    {"geometry_msgs::msg::dds_::TwistStamped_", &geometry_msgs_msg_dds__TwistStamped__desc},
    {"geometry_msgs::msg::dds_::TwistWithCovarianceStamped_",
     &geometry_msgs_msg_dds__TwistWithCovarianceStamped__desc},
    {"geometry_msgs::msg::dds_::TwistWithCovariance_",
     &geometry_msgs_msg_dds__TwistWithCovariance__desc},
    {"geometry_msgs::msg::dds_::Twist_", &geometry_msgs_msg_dds__Twist__desc},
    {"geometry_msgs::msg::dds_::Vector3_", &geometry_msgs_msg_dds__Vector3__desc},
    {"inspire::inspire_hand_ctrl", &inspire_inspire_hand_ctrl_desc},
    {"inspire::inspire_hand_state", &inspire_inspire_hand_state_desc},
    {"inspire::inspire_hand_touch", &inspire_inspire_hand_touch_desc},
    {"nav_msgs::msg::dds_::MapMetaData_", &nav_msgs_msg_dds__MapMetaData__desc},
    {"nav_msgs::msg::dds_::OccupancyGrid_", &nav_msgs_msg_dds__OccupancyGrid__desc},
    {"nav_msgs::msg::dds_::Odometry_", &nav_msgs_msg_dds__Odometry__desc},
    {"sensor_msgs::msg::dds_::Imu_", &sensor_msgs_msg_dds__Imu__desc},
    {"sensor_msgs::msg::dds_::PointCloud2_", &sensor_msgs_msg_dds__PointCloud2__desc},
    {"sensor_msgs::msg::dds_::PointField_", &sensor_msgs_msg_dds__PointField__desc},
    {"std_msgs::msg::dds_::Header_", &std_msgs_msg_dds__Header__desc},
    {"std_msgs::msg::dds_::String_", &std_msgs_msg_dds__String__desc},
    {"unitree_api::msg::dds_::RequestHeader_", &unitree_api_msg_dds__RequestHeader__desc},
    {"unitree_api::msg::dds_::RequestIdentity_", &unitree_api_msg_dds__RequestIdentity__desc},
    {"unitree_api::msg::dds_::RequestLease_", &unitree_api_msg_dds__RequestLease__desc},
    {"unitree_api::msg::dds_::RequestPolicy_", &unitree_api_msg_dds__RequestPolicy__desc},
    {"unitree_api::msg::dds_::Request_", &unitree_api_msg_dds__Request__desc},
    {"unitree_api::msg::dds_::ResponseHeader_", &unitree_api_msg_dds__ResponseHeader__desc},
    {"unitree_api::msg::dds_::ResponseStatus_", &unitree_api_msg_dds__ResponseStatus__desc},
    {"unitree_api::msg::dds_::Response_", &unitree_api_msg_dds__Response__desc},
    {"unitree_go::msg::dds_::AudioData_", &unitree_go_msg_dds__AudioData__desc},
    {"unitree_go::msg::dds_::BmsCmd_", &unitree_go_msg_dds__BmsCmd__desc},
    {"unitree_go::msg::dds_::BmsState_", &unitree_go_msg_dds__BmsState__desc},
    {"unitree_go::msg::dds_::ConfigChangeStatus_", &unitree_go_msg_dds__ConfigChangeStatus__desc},
    {"unitree_go::msg::dds_::Error_", &unitree_go_msg_dds__Error__desc},
    {"unitree_go::msg::dds_::Go2FrontVideoData_", &unitree_go_msg_dds__Go2FrontVideoData__desc},
    {"unitree_go::msg::dds_::HeightMap_", &unitree_go_msg_dds__HeightMap__desc},
    {"unitree_go::msg::dds_::IMUState_", &unitree_go_msg_dds__IMUState__desc},
    {"unitree_go::msg::dds_::InterfaceConfig_", &unitree_go_msg_dds__InterfaceConfig__desc},
    {"unitree_go::msg::dds_::LidarState_", &unitree_go_msg_dds__LidarState__desc},
    {"unitree_go::msg::dds_::LowCmd_", &unitree_go_msg_dds__LowCmd__desc},
    {"unitree_go::msg::dds_::LowState_", &unitree_go_msg_dds__LowState__desc},
    {"unitree_go::msg::dds_::MotorCmd_", &unitree_go_msg_dds__MotorCmd__desc},
    {"unitree_go::msg::dds_::MotorCmds_", &unitree_go_msg_dds__MotorCmds__desc},
    {"unitree_go::msg::dds_::MotorState_", &unitree_go_msg_dds__MotorState__desc},
    {"unitree_go::msg::dds_::MotorStates_", &unitree_go_msg_dds__MotorStates__desc},
    {"unitree_go::msg::dds_::PathPoint_", &unitree_go_msg_dds__PathPoint__desc},
    {"unitree_go::msg::dds_::Req_", &unitree_go_msg_dds__Req__desc},
    {"unitree_go::msg::dds_::Res_", &unitree_go_msg_dds__Res__desc},
    {"unitree_go::msg::dds_::SportModeCmd_", &unitree_go_msg_dds__SportModeCmd__desc},
    {"unitree_go::msg::dds_::SportModeState_", &unitree_go_msg_dds__SportModeState__desc},
    {"unitree_go::msg::dds_::TimeSpec_", &unitree_go_msg_dds__TimeSpec__desc},
    {"unitree_go::msg::dds_::UwbState_", &unitree_go_msg_dds__UwbState__desc},
    {"unitree_go::msg::dds_::UwbSwitch_", &unitree_go_msg_dds__UwbSwitch__desc},
    {"unitree_go::msg::dds_::VoxelHeightMapState_", &unitree_go_msg_dds__VoxelHeightMapState__desc},
    {"unitree_go::msg::dds_::VoxelMapCompressed_", &unitree_go_msg_dds__VoxelMapCompressed__desc},
    {"unitree_go::msg::dds_::WirelessController_", &unitree_go_msg_dds__WirelessController__desc},
    {"unitree_hg::msg::dds_::AgvBmsState_", &unitree_hg_msg_dds__AgvBmsState__desc},
    {"unitree_hg::msg::dds_::BmsCmd_", &unitree_hg_msg_dds__BmsCmd__desc},
    {"unitree_hg::msg::dds_::BmsState_", &unitree_hg_msg_dds__BmsState__desc},
    {"unitree_hg::msg::dds_::HandCmd_", &unitree_hg_msg_dds__HandCmd__desc},
    {"unitree_hg::msg::dds_::HandState_", &unitree_hg_msg_dds__HandState__desc},
    {"unitree_hg::msg::dds_::IMUState_", &unitree_hg_msg_dds__IMUState__desc},
    {"unitree_hg::msg::dds_::LowCmd_", &unitree_hg_msg_dds__LowCmd__desc},
    {"unitree_hg::msg::dds_::LowState_", &unitree_hg_msg_dds__LowState__desc},
    {"unitree_hg::msg::dds_::MainBoardState_", &unitree_hg_msg_dds__MainBoardState__desc},
    {"unitree_hg::msg::dds_::MotorCmd_", &unitree_hg_msg_dds__MotorCmd__desc},
    {"unitree_hg::msg::dds_::MotorState_", &unitree_hg_msg_dds__MotorState__desc},
    {"unitree_hg::msg::dds_::PressSensorState_", &unitree_hg_msg_dds__PressSensorState__desc},
    {"unitree_hg::msg::dds_::SportModeState_", &unitree_hg_msg_dds__SportModeState__desc},
    {"unitree_hg_doubleimu::msg::dds_::doubleIMUState_",
     &unitree_hg_doubleimu_msg_dds__doubleIMUState__desc},
});

constexpr bool NameLess(const MessageType& a, const MessageType& b) { return a.name < b.name; }

// FindMessageType searches by halves.
static_assert(std::is_sorted(kMessageTypes.begin(), kMessageTypes.end(), NameLess));

}  // namespace

std::span<const MessageType> MessageTypes() { return kMessageTypes; }

const MessageType* FindMessageType(std::string_view name) {
  const auto* it = std::lower_bound(
      kMessageTypes.begin(), kMessageTypes.end(), name,
      [](const MessageType& type, std::string_view wanted) { return type.name < wanted; });
  return it != kMessageTypes.end() && it->name == name ? it : nullptr;
}

}  // namespace understudy
