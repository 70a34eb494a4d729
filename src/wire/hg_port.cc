#include "wire/hg_port.h"

#include "wire/hg_codec.h"
#include "wire/imu_codec.h"
#include "wire/motion_codec.h"
#include "wire/slots.h"
#include "wire/topics.h"

namespace understudy {

HgPort::HgPort(const Participant& participant, const RobotSpec& spec)
    : spec_(spec),
      commands_(participant, kHgLowCmd),
      lowstate_(participant, kHgLowState),
      lf_lowstate_(participant, kHgLfLowState),
      motion_(participant, kOdomModeState),
      lf_motion_(participant, kLfOdomModeState),
      lf_bms_(participant, kLfBmsState) {
  CheckFits(spec, kHgMotorSlots, kHgCells);
  if (!spec.imu.secondary_site.empty()) {
    secondary_.emplace(SecondaryImu{.imu = Writer(participant, kSecondaryImu),
                                    .lf_imu = Writer(participant, kLfSecondaryImu)});
  }
}

bool HgPort::TakeCommand(RobotCommand* command, Refusal* wire) {
  const auto visit = [&](const unitree_hg_msg_dds__LowCmd_& message, WriterHandle) {
    *wire = Decode(message, spec_, command);
    counts_.unused_slots += static_cast<std::uint64_t>(UnusedSlotCommands(message, spec_));
  };
  return commands_.Take(visit, 1) == 1;
}

void HgPort::Publish(const RobotState& state, const Due& due) {
  if (due.lowstate || due.lf) {
    Encode(state, spec_, &lowstate_message_);
    if (secondary_) EncodeImu(state.secondary_imu, &secondary_->message);
  }
  if (due.motion || due.lf) EncodeMotion(state, &motion_message_);
  if (due.lowstate) {
    lowstate_.Write(lowstate_message_);
    if (secondary_) secondary_->imu.Write(secondary_->message);
  }
  if (due.motion) motion_.Write(motion_message_);
  if (due.lf) {
    EncodeBms(state, spec_, &bms_message_);
    lf_lowstate_.Write(lowstate_message_);
    lf_motion_.Write(motion_message_);
    lf_bms_.Write(bms_message_);
    if (secondary_) secondary_->lf_imu.Write(secondary_->message);
  }
}

PortCounts HgPort::counts() const {
  PortCounts counts = counts_;
  const std::uint64_t secondary =
      secondary_ ? secondary_->imu.failures() + secondary_->lf_imu.failures() : 0;
  counts.write_failures = lowstate_.failures() + lf_lowstate_.failures() + motion_.failures() +
                          lf_motion_.failures() + lf_bms_.failures() + secondary;
  return counts;
}

}  // namespace understudy
