#include "services/switch_topics.h"

#include <string_view>

#include <nlohmann/json.hpp>

namespace understudy::services {

SwitchTopics::SwitchTopics(const bus::Participant& participant, Service* uwb_switch)
    : uwb_switch_(uwb_switch),
      lidar_(participant, {"rt/utlidar/switch", &std_msgs_msg_dds__String__desc}),
      uwb_(participant, {"rt/uwbswitch", &unitree_go_msg_dds__UwbSwitch__desc}) {}

void SwitchTopics::Poll(authority::MotorOwner* owner) {
  lidar_.Take([&](const std_msgs_msg_dds__String_& message, bus::WriterHandle) {
    const std::string_view word = message.data == nullptr ? "" : message.data;
    if (word == "ON" || word == "OFF") owner->Switch("unitree_lidar", word == "ON");
  });
  uwb_.Take([&](const unitree_go_msg_dds__UwbSwitch_& message, bus::WriterHandle) {
    uwb_switch_->Set("enable", message.enabled == 0 ? 0 : 1);
  });
}

}  // namespace understudy::services
