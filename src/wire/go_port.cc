#include "wire/go_port.h"

#include "wire/go_codec.h"
#include "wire/remote_codec.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy::wire {

GoPort::GoPort(const bus::Participant& participant, const robot::RobotSpec& spec)
    : spec_(spec),
      motion_fields_(MotionFieldsOf(spec)),
      commands_(participant, kGoLowCmd),
      lowstate_(participant, kGoLowState),
      lf_lowstate_(participant, kGoLfLowState),
      motion_(participant, kSportModeState),
      lf_motion_(participant, kLfSportModeState),
      remote_(participant, kWirelessController) {
  CheckFits(spec, kGoMotorSlots, kGoCells);
  if (!spec.arm_sdk.slots.empty()) arm_commands_.emplace(participant, kGoArmSdk);
}

bool GoPort::TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) {
  const auto visit = [&](const unitree_go_msg_dds__LowCmd_& message, bus::WriterHandle) {
    *wire = Decode(message, spec_, command);
    if (HeadIsUnset(message)) ++counts_.unset_heads;
    counts_.unused_slots += static_cast<std::uint64_t>(UnusedSlotCommands(message, spec_));
  };
  return commands_.Take(visit, 1) == 1;
}

bool GoPort::TakeArmCommand(robot::RobotCommand* command, double* weight) {
  if (!arm_commands_) return false;
  const auto visit = [&](const unitree_go_msg_dds__LowCmd_& message, bus::WriterHandle) {
    DecodeUnsigned(message, spec_, command);
    *weight = ArmWeight(message, spec_.arm_sdk);
  };
  return arm_commands_->Take(visit, 1) == 1;
}

bool GoPort::TakeUserCommand(robot::RobotCommand*) { return false; }

void GoPort::Publish(const robot::RobotState& state, const Due& due) {
  const bool lowstate = due.lowstate && lowstate_.has_readers();
  const bool lf_lowstate = due.lf && lf_lowstate_.has_readers();
  if (lowstate || lf_lowstate) Encode(state, spec_, &lowstate_message_);
  if (lowstate) lowstate_.Write(lowstate_message_);
  if (lf_lowstate) lf_lowstate_.Write(lowstate_message_);

  const bool motion = due.motion && motion_.has_readers();
  const bool lf_motion = due.lf && lf_motion_.has_readers();
  if (motion || lf_motion) EncodeMotion(state, spec_, motion_fields_, &motion_message_);
  if (motion) motion_.Write(motion_message_);
  if (lf_motion) lf_motion_.Write(motion_message_);

  if (due.motion && state.remote.there && remote_.has_readers()) {
    EncodeRemote(state.remote, &remote_message_);
    remote_.Write(remote_message_);
  }
}

robot::PortCounts GoPort::counts() const {
  robot::PortCounts counts = counts_;
  counts.write_failures = lowstate_.failures() + lf_lowstate_.failures() + motion_.failures() +
                          lf_motion_.failures() + remote_.failures();
  return counts;
}

}  // namespace understudy::wire
