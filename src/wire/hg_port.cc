// Topics of the unitree_hg family, including those of hands.
#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>

#include "base/errors.h"
#include "robot/firmware.h"
#include "wire/hand_codec.h"
#include "wire/hg_codec.h"
#include "wire/imu_codec.h"
#include "wire/motion_codec.h"
#include "wire/port.h"
#include "wire/slots.h"
#include "wire/state_rows.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

// Throws ModelError if the hand has more motors, or a pad other taxels, than the messages have.
void CheckFits(const robot::HandSpec& spec) {
  if (spec.motors.size() > kHandIds) {
    throw ModelError("hand " + spec.name + " has " + std::to_string(spec.motors.size()) +
                     " motors, the mode byte tells " + std::to_string(kHandIds) + " apart");
  }
  constexpr double kTaxels = std::size(unitree_hg_msg_dds__PressSensorState_{}.pressure);
  for (const robot::PadSpec& pad : spec.pads) {
    for (const int taxel : pad.taxels) {
      if (taxel >= 0 && taxel < kTaxels) continue;
      throw ModelError("hand " + spec.name + " has a pad with a taxel beyond 0..11");
    }
  }
}

// `first_motor` is its first index in motor order.
StateRow HandRow(const robot::RobotSpec& robot, const robot::HandSpec& spec,
                 std::size_t first_motor) {
  using HandState = unitree_hg_msg_dds__HandState_;
  CheckFits(spec);
  const std::string state = "rt/" + spec.topic + "/state";
  const std::string slow = "rt/lf/" + spec.topic + "/state";
  const dds_topic_descriptor* const type = &unitree_hg_msg_dds__HandState__desc;
  return RowOf({TopicRow{bus::Topic<HandState>{state.c_str(), type}, robot.rates.hand_hz},
                {{slow.c_str(), type}, robot.rates.lf_hz}},
               [first_motor, encoder = HandStateMessage(spec)](const robot::RobotState& told,
                                                               HandState* message) mutable {
                 encoder.Encode(std::span(told.motors).subspan(first_motor));
                 *message = encoder.message();
                 return true;
               });
}

}  // namespace

void Port::HearHg() {
  using LowCmd = unitree_hg_msg_dds__LowCmd_;
  using HandCmd = unitree_hg_msg_dds__HandCmd_;
  CheckFits(spec_, kHgMotorSlots, kHgCells);

  Hear(robot::kLowCmdTopic, kHgLowCmd, [this](const LowCmd& message, robot::RobotCommand* command) {
    NoteUnusedSlots(UnusedSlotCommands(message, spec_));
    return Decode(message, spec_, command);
  });
  const auto decode_unsigned = [this](const LowCmd& message, robot::RobotCommand* command) {
    return DecodeUnsigned(message, spec_, command);
  };
  if (!spec_.arm_sdk.slots.empty()) Hear(robot::kArmSdkTopic, kHgArmSdk, decode_unsigned);
  if (spec_.user_lowcmd) Hear(robot::kUserLowCmdTopic, kUserLowCmd, decode_unsigned);
  for (std::size_t hand = 0; hand < spec_.hands.size(); ++hand) {
    const robot::HandSpec& spec = spec_.hands[hand];
    const std::string topic = "rt/" + spec.topic + "/cmd";
    Hear(robot::kFirstHandTopic + hand,
         bus::Topic<HandCmd>{topic.c_str(), &unitree_hg_msg_dds__HandCmd__desc},
         [&spec](const HandCmd& message, robot::RobotCommand* command) {
           return Decode(message, spec, command);
         });
  }
}

std::vector<StateRow> HgStates(const robot::RobotSpec& spec) {
  const robot::RateSpec& rates = spec.rates;
  std::vector<StateRow> rows = {
      RowOf({TopicRow{kHgLowState, rates.lowstate_hz}, {kHgLfLowState, rates.lf_hz}},
            [&spec](const robot::RobotState& state, unitree_hg_msg_dds__LowState_* message) {
              Encode(state, spec, message);
              return true;
            }),
      MotionRow(spec, kOdomModeState, kLfOdomModeState)};
  if (!spec.imu.secondary_site.empty()) {
    rows.push_back(
        RowOf({TopicRow{kSecondaryImu, rates.lowstate_hz}, {kLfSecondaryImu, rates.lf_hz}},
              [](const robot::RobotState& state, unitree_hg_msg_dds__IMUState_* message) {
                EncodeImu(state.secondary_imu, message);
                return true;
              }));
  }
  rows.push_back(RemoteRow(spec));
  rows.push_back(
      RowOf({TopicRow{kLfBmsState, rates.lf_hz}},
            [&spec](const robot::RobotState& state, unitree_hg_msg_dds__BmsState_* message) {
              EncodeBms(state, spec, message);
              return true;
            }));
  // The content of MainBoardState_ is not documented: all 0.
  rows.push_back(
      RowOf({TopicRow{kLfMainBoardState, rates.lf_hz}},
            [](const robot::RobotState&, unitree_hg_msg_dds__MainBoardState_*) { return true; }));
  std::size_t motor = spec.motors.size();
  for (const robot::HandSpec& hand : spec.hands) {
    rows.push_back(HandRow(spec, hand, motor));
    motor += hand.motors.size();
  }

  // The state of the motion service, while one is on.
  if (robot::TellsStateId(spec)) {
    rows.push_back(
        RowOf({TopicRow{kHgSportModeState, rates.motion_hz}, {kLfHgSportModeState, rates.lf_hz}},
              [](const robot::RobotState& state, unitree_hg_msg_dds__SportModeState_* message) {
                if (state.motion) EncodeFsm(state, message);
                return state.motion.has_value();
              }));
  }
  if (spec.arm_action_state) {
    constexpr double kHz = 10;  // a G1 with firmware 1.4.7, 3795 gaps of 0.102 s in the median
    rows.push_back(
        RowOf({TopicRow{kArmActionState, kHz}},
              [text = std::array<char, 96>()](const robot::RobotState& state,
                                              std_msgs_msg_dds__String_* message) mutable {
                if (state.motion) text = ArmActionText(*state.motion);
                message->data = text.data();
                return state.motion.has_value();
              }));
  }
  return rows;
}

}  // namespace understudy::wire
