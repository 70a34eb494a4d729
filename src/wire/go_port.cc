// Topics of the unitree_go family.
#include "wire/error_list.h"
#include "wire/go_codec.h"
#include "wire/port.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy::wire {

void Port::OpenGo() {
  using LowCmd = unitree_go_msg_dds__LowCmd_;
  using LowState = unitree_go_msg_dds__LowState_;
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

  const robot::RateSpec& rates = spec_.rates;
  Tell({TopicRow{kGoLowState, rates.lowstate_hz}, {kGoLfLowState, rates.lf_hz}},
       [this](const robot::RobotState& state, LowState* message) {
         Encode(state, spec_, message);
         return true;
       });
  TellMotion(kSportModeState, kLfSportModeState);
  TellRemote();
  if (spec_.error_list) {
    Tell({TopicRow{kErrorList, rates.lf_hz}},
         [list = ErrorList(spec_)](const robot::RobotState& state,
                                   std_msgs_msg_dds__String_* message) mutable {
           if (!list.Update(state)) return false;
           message->data = list.text();
           return true;
         });
  }
}

}  // namespace understudy::wire
