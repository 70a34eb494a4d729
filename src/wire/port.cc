#include "wire/port.h"

#include <algorithm>

#include "wire/motion_codec.h"
#include "wire/remote_codec.h"
#include "wire/topics.h"

namespace understudy::wire {

Port::Port(const bus::Participant& participant, const robot::RobotSpec& spec, double timestep)
    : participant_(participant),
      spec_(spec),
      timestep_(timestep),
      lowstate_(spec.rates.lowstate_hz, timestep) {
  spec.family == robot::WireFamily::kGo ? OpenGo() : OpenHg();
}

bool Port::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  return sources_[topic] != nullptr && sources_[topic]->Take(command, form);
}

bool Port::Due(std::int64_t step) const {
  return std::ranges::any_of(publications_, [step](const auto& p) { return p->Due(step); });
}

void Port::Publish(const robot::RobotState& state, std::int64_t step) {
  for (const auto& publication : publications_) publication->Publish(state, step);
  if (lowstate_.Due(step)) ++counts_.lowstates;
}

int Port::command_writers() const { return sources_[robot::kLowCmdTopic]->writers(); }

robot::PortCounts Port::counts() const {
  robot::PortCounts counts = counts_;
  for (const auto& publication : publications_) counts.write_failures += publication->failures();
  return counts;
}

void Port::TellMotion(const bus::Topic<unitree_go_msg_dds__SportModeState_>& topic,
                      const bus::Topic<unitree_go_msg_dds__SportModeState_>& slow) {
  const auto encode = [this, fields = MotionFieldsOf(spec_)](
                          const robot::RobotState& state,
                          unitree_go_msg_dds__SportModeState_* message) {
    EncodeMotion(state, spec_, fields, message);
    return true;
  };
  Tell({TopicRow{topic, spec_.rates.motion_hz}, {slow, spec_.rates.lf_hz}}, encode);
}

void Port::TellRemote() {
  const auto encode = [](const robot::RobotState& state,
                         unitree_go_msg_dds__WirelessController_* message) {
    if (state.remote.there) EncodeRemote(state.remote, message);
    return state.remote.there;
  };
  Tell({TopicRow{kWirelessController, spec_.rates.motion_hz}}, encode);
}

}  // namespace understudy::wire
