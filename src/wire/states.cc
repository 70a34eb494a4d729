#include "wire/states.h"

#include "wire/motion_codec.h"
#include "wire/remote_codec.h"
#include "wire/state_rows.h"
#include "wire/topics.h"

namespace understudy::wire {

std::vector<StateRow> StateRows(const robot::RobotSpec& spec) {
  return spec.family == robot::WireFamily::kGo ? GoStates(spec) : HgStates(spec);
}

std::vector<StateTopic> StateTopics(const robot::RobotSpec& spec) {
  std::vector<StateTopic> topics;
  for (const StateRow& row : StateRows(spec)) {
    topics.insert(topics.end(), row.topics.begin(), row.topics.end());
  }
  return topics;
}

StateRow MotionRow(const robot::RobotSpec& spec,
                   const bus::Topic<unitree_go_msg_dds__SportModeState_>& topic,
                   const bus::Topic<unitree_go_msg_dds__SportModeState_>& slow) {
  return RowOf({TopicRow{topic, spec.rates.motion_hz}, {slow, spec.rates.lf_hz}},
               [&spec, fields = MotionFieldsOf(spec)](
                   const robot::RobotState& state, unitree_go_msg_dds__SportModeState_* message) {
                 EncodeMotion(state, spec, fields, message);
                 return true;
               });
}

StateRow RemoteRow(const robot::RobotSpec& spec) {
  return RowOf(
      {TopicRow{kWirelessController, spec.rates.motion_hz}},
      [](const robot::RobotState& state, unitree_go_msg_dds__WirelessController_* message) {
        if (state.remote.there) EncodeRemote(state.remote, message);
        return state.remote.there;
      });
}

}  // namespace understudy::wire
