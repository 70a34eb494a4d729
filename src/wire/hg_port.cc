#include "wire/hg_port.h"

#include <algorithm>

#include "robot/firmware.h"
#include "wire/hg_codec.h"
#include "wire/imu_codec.h"
#include "wire/remote_codec.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy::wire {
HgPort::HgPort(const bus::Participant& participant, const robot::RobotSpec& spec)
    : spec_(spec),
      motion_fields_(MotionFieldsOf(spec)),
      commands_(participant, kHgLowCmd),
      lowstate_(participant, kHgLowState),
      lf_lowstate_(participant, kHgLfLowState),
      motion_(participant, kOdomModeState),
      lf_motion_(participant, kLfOdomModeState),
      lf_bms_(participant, kLfBmsState),
      lf_board_(participant, kLfMainBoardState),
      remote_(participant, kWirelessController) {
  CheckFits(spec, kHgMotorSlots, kHgCells);
  if (!spec.arm_sdk.slots.empty()) arm_commands_.emplace(participant, kHgArmSdk);
  if (spec.user_lowcmd) user_commands_.emplace(participant, kUserLowCmd);
  if (robot::TellsStateId(spec)) {
    fsm_.emplace(Fsm{.state = bus::Writer(participant, kHgSportModeState),
                     .lf_state = bus::Writer(participant, kLfHgSportModeState)});
  }
  if (spec.arm_action_state) arm_action_.emplace(participant, kArmActionState);
  for (const robot::HandSpec& hand : spec.hands) hands_.emplace_back(participant, hand);
  if (!spec.imu.secondary_site.empty()) {
    secondary_.emplace(SecondaryImu{.imu = bus::Writer(participant, kSecondaryImu),
                                    .lf_imu = bus::Writer(participant, kLfSecondaryImu)});
  }
}

bool HgPort::TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) {
  const auto visit = [&](const unitree_hg_msg_dds__LowCmd_& message, bus::WriterHandle) {
    *wire = Decode(message, spec_, command);
    counts_.unused_slots += static_cast<std::uint64_t>(UnusedSlotCommands(message, spec_));
  };
  return commands_.Take(visit, 1) == 1;
}

bool HgPort::TakeArmCommand(robot::RobotCommand* command, double* weight) {
  if (!arm_commands_) return false;
  const auto visit = [&](const unitree_hg_msg_dds__LowCmd_& message, bus::WriterHandle) {
    DecodeUnsigned(message, spec_, command);
    *weight = ArmWeight(message, spec_.arm_sdk);
  };
  return arm_commands_->Take(visit, 1) == 1;
}

bool HgPort::TakeUserCommand(robot::RobotCommand* command) {
  if (!user_commands_) return false;
  const auto visit = [&](const unitree_hg_msg_dds__LowCmd_& message, bus::WriterHandle) {
    DecodeUnsigned(message, spec_, command);
  };
  return user_commands_->Take(visit, 1) == 1;
}

bool HgPort::TakeHandCommand(std::size_t hand, robot::HandCommand* command, robot::Refusal* wire) {
  return hands_[hand].Take(command, wire);
}

void HgPort::Publish(const robot::RobotState& state, const Due& due) {
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

  if (secondary_) PublishSecondaryImu(state.secondary_imu, due);
  if (due.motion && state.remote.there && remote_.has_readers()) {
    EncodeRemote(state.remote, &remote_message_);
    remote_.Write(remote_message_);
  }
  if (due.lf && lf_bms_.has_readers()) {
    EncodeBms(state, spec_, &bms_message_);
    lf_bms_.Write(bms_message_);
  }
  if (due.lf) lf_board_.Write(unitree_hg_msg_dds__MainBoardState_{});
  for (std::size_t i = 0; i < hands_.size(); ++i) hands_[i].Publish(state.hands[i], due);
  if (state.motion) PublishService(state, due);
}

void HgPort::PublishSecondaryImu(const robot::ImuReading& reading, const Due& due) {
  const bool imu = due.lowstate && secondary_->imu.has_readers();
  const bool lf_imu = due.lf && secondary_->lf_imu.has_readers();
  if (imu || lf_imu) EncodeImu(reading, &secondary_->message);
  if (imu) secondary_->imu.Write(secondary_->message);
  if (lf_imu) secondary_->lf_imu.Write(secondary_->message);
}

void HgPort::PublishService(const robot::RobotState& state, const Due& due) {
  if (fsm_) {
    const bool fsm = due.motion && fsm_->state.has_readers();
    const bool lf_fsm = due.lf && fsm_->lf_state.has_readers();
    if (fsm || lf_fsm) EncodeFsm(state, &fsm_->message);
    if (fsm) fsm_->state.Write(fsm_->message);
    if (lf_fsm) fsm_->lf_state.Write(fsm_->message);
  }
  if (arm_action_ && due.lf) {
    std::array<char, 96> text = ArmActionText(*state.motion);
    arm_action_->Write({.data = text.data()});
  }
}

robot::PortCounts HgPort::counts() const {
  robot::PortCounts counts = counts_;
  const std::uint64_t secondary =
      secondary_ ? secondary_->imu.failures() + secondary_->lf_imu.failures() : 0;
  const std::uint64_t service = (fsm_ ? fsm_->state.failures() + fsm_->lf_state.failures() : 0) +
                                (arm_action_ ? arm_action_->failures() : 0);
  counts.write_failures = lowstate_.failures() + lf_lowstate_.failures() + motion_.failures() +
                          lf_motion_.failures() + lf_bms_.failures() + lf_board_.failures() +
                          remote_.failures() + secondary + service;
  for (const HandPort& hand : hands_) counts.write_failures += hand.failures();
  return counts;
}

}  // namespace understudy::wire
