#include "services/switch_topics.h"

#include <string_view>

#include "wire/topics.h"

namespace understudy::services {

SwitchTopics::SwitchTopics(const bus::Participant& participant, Service* uwb_switch,
                           std::atomic<bool>* mail)
    : uwb_switch_(uwb_switch),
      lidar_(participant, wire::kLidarSwitch, {.mail = mail}),
      uwb_(participant, wire::kUwbSwitch, {.mail = mail}) {}

void SwitchTopics::Poll(authority::MotorOwner* owner, std::vector<Call>* calls) {
  lidar_.Take([&](const std_msgs_msg_dds__String_& message, bus::WriterHandle) {
    const std::string_view word = message.data == nullptr ? "" : message.data;
    if (word == "ON" || word == "OFF") {
      owner->Switch(authority::kLidarProgram, word == "ON");
    } else {
      calls->push_back(
          {.service = lidar_.topic(), .code = Call::kNoCode, .refusal = CallRefusal::kName});
    }
  });
  uwb_.Take([&](const unitree_go_msg_dds__UwbSwitch_& message, bus::WriterHandle) {
    uwb_switch_->Set("enable", message.enabled == 0 ? 0 : 1);
  });
}

}  // namespace understudy::services
