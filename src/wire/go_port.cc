// Topics of the unitree_go family.
#include "wire/error_list.h"
#include "wire/go_codec.h"
#include "wire/port.h"
#include "wire/slots.h"
#include "wire/state_rows.h"
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

std::vector<StateRow> GoStates(const robot::RobotSpec& spec) {
  const robot::RateSpec& rates = spec.rates;
  std::vector<StateRow> rows = {
      RowOf({TopicRow{kGoLowState, rates.lowstate_hz}, {kGoLfLowState, rates.lf_hz}},
            [&spec](const robot::RobotState& state, unitree_go_msg_dds__LowState_* message) {
              Encode(state, spec, message);
              return true;
            }),
      MotionRow(spec, kSportModeState, kLfSportModeState), RemoteRow(spec)};
  if (spec.error_list) {
    rows.push_back(RowOf({TopicRow{kErrorList, rates.lf_hz}},
                         [list = ErrorList(spec)](const robot::RobotState& state,
                                                  std_msgs_msg_dds__String_* message) mutable {
                           if (!list.Update(state)) return false;
                           message->data = list.text();
                           return true;
                         }));
  }
  return rows;
}

}  // namespace understudy::wire
