// Topics of the unitree_go family.
#include "wire/error_list.h"
#include "wire/go_codec.h"
#include "wire/odometry_codec.h"
#include "wire/port.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy::wire {

void Port::HearGo() {
  using LowCmd = unitree_go_msg_dds__LowCmd_;
  CheckFits(spec_, kGoMotorSlots, kGoCells);

  Hear(robot::kLowCmdTopic, kGoLowCmd, [this](const LowCmd& message, robot::RobotCommand* command) {
    if (HeadIsUnset(message)) NoteUnsetHead();
    NoteUnusedSlots(UnusedSlotCommands(message, spec_));
    return Decode(message, spec_, command);
  });
  if (!spec_.arm_sdk.slots.empty()) {
    Hear(robot::kArmSdkTopic, kGoArmSdk,
         [this](const LowCmd& message, robot::RobotCommand* command) {
           return DecodeUnsigned(message, spec_, command);
         });
  }
}

std::unique_ptr<Publication> Port::OpenGo(const StateMessage& message) {
  switch (message.content) {
    case Content::kLowState:
      return Open<unitree_go_msg_dds__LowState_>(
          message, [this](const robot::RobotState& state, unitree_go_msg_dds__LowState_* sent) {
            Encode(state, spec_, sent);
            return true;
          });
    case Content::kOdometry:
      return Open<nav_msgs_msg_dds__Odometry_>(message, &EncodeOdometry);
    case Content::kOdometryPose:
      return Open<geometry_msgs_msg_dds__PoseStamped_>(message, &EncodePose);
    case Content::kErrors:
      return Open<std_msgs_msg_dds__String_>(
          message, [list = ErrorList(spec_)](const robot::RobotState& state,
                                             std_msgs_msg_dds__String_* sent) mutable {
            if (!list.Update(state)) return false;
            sent->data = list.text();
            return true;
          });
    default:
      return OpenShared(message);
  }
}

}  // namespace understudy::wire
