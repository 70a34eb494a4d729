// Topics of the unitree_hg family, including those of hands.
#include <algorithm>
#include <array>
#include <iterator>
#include <span>
#include <string>
#include <utility>

#include "base/errors.h"
#include "robot/hand_law.h"
#include "wire/hand_codec.h"
#include "wire/hg_codec.h"
#include "wire/imu_codec.h"
#include "wire/motion_codec.h"
#include "wire/port.h"
#include "wire/register_codec.h"
#include "wire/slots.h"
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
      if (taxel >= 0 && taxel < kTaxels && taxel < static_cast<int>(robot::CellsOf(pad))) continue;
      throw ModelError("hand " + spec.name + " has a pad with a taxel beyond 0..11, or its cells");
    }
  }
}

// What the cells from the first one on show; nothing before the first sample.
std::span<const float> TouchFrom(const robot::RobotState& state, std::size_t first) {
  return std::span(state.touch).subspan(std::min(first, state.touch.size()));
}

}  // namespace

void Port::HearHg() {
  using LowCmd = unitree_hg_msg_dds__LowCmd_;
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
  if (robot::HasHandSdk(spec_)) {
    Hear(robot::kHandSdkTopic, kHandSdk,
         [this](const unitree_go_msg_dds__MotorCmds_& message, robot::RobotCommand* command) {
           return DecodeHandSdk(message, spec_, command);
         });
  }
  const std::vector<RobotTopic> topics = CommandTopics(spec_);
  for (std::size_t hand = 0; hand < spec_.hands.size(); ++hand) {
    HearHand(hand, topics[robot::kFirstHandTopic + hand].name);
  }
}

void Port::HearHand(std::size_t hand, const std::string& topic) {
  using HandCmd = unitree_hg_msg_dds__HandCmd_;
  using MotorCmds = unitree_go_msg_dds__MotorCmds_;
  const robot::HandSpec& spec = spec_.hands[hand];
  const std::size_t number = robot::kFirstHandTopic + hand;
  const auto decode = [&spec](const auto& message, robot::RobotCommand* command) {
    return Decode(message, spec, command);
  };
  const char* const name = topic.c_str();
  switch (robot::LawOf(spec).messages) {
    case robot::HandLaw::Messages::kHand:
      Hear(number, bus::Topic<HandCmd>{name, &unitree_hg_msg_dds__HandCmd__desc}, decode);
      break;
    case robot::HandLaw::Messages::kMotors:
      Hear(number, bus::Topic<MotorCmds>{name, &unitree_go_msg_dds__MotorCmds__desc}, decode);
      break;
    case robot::HandLaw::Messages::kRegisters:
      Hear(number, bus::Topic<inspire_inspire_hand_ctrl>{name, &inspire_inspire_hand_ctrl_desc},
           decode);
      break;
  }
}

std::unique_ptr<Publication> Port::OpenHg(const StateMessage& message) {
  switch (message.content) {
    case Content::kLowState:
      return Open<unitree_hg_msg_dds__LowState_>(
          message, [this](const robot::RobotState& state, unitree_hg_msg_dds__LowState_* sent) {
            Encode(state, spec_, sent);
            return true;
          });
    case Content::kSecondImu:
      return Open<unitree_hg_msg_dds__IMUState_>(
          message, [](const robot::RobotState& state, unitree_hg_msg_dds__IMUState_* sent) {
            EncodeImu(state.secondary_imu, sent);
            return true;
          });
    case Content::kBms:
      return Open<unitree_hg_msg_dds__BmsState_>(
          message, [this](const robot::RobotState& state, unitree_hg_msg_dds__BmsState_* sent) {
            EncodeBms(state, spec_, sent);
            return true;
          });
    case Content::kMainBoard:  // its content is not documented: all 0
      return Open<unitree_hg_msg_dds__MainBoardState_>(
          message,
          [](const robot::RobotState&, unitree_hg_msg_dds__MainBoardState_*) { return true; });
    case Content::kHand:
      return OpenHand(message);
    case Content::kTouch:
      return OpenTouch(message);
    case Content::kFsm:  // while a motion service is on
      return Open<unitree_hg_msg_dds__SportModeState_>(
          message, [](const robot::RobotState& state, unitree_hg_msg_dds__SportModeState_* sent) {
            if (state.motion) EncodeFsm(state, sent);
            return state.motion.has_value();
          });
    case Content::kArmAction:
      return Open<std_msgs_msg_dds__String_>(
          message, [text = std::array<char, 96>()](const robot::RobotState& state,
                                                   std_msgs_msg_dds__String_* sent) mutable {
            if (state.motion) text = ArmActionText(*state.motion);
            sent->data = text.data();
            return state.motion.has_value();
          });
    default:
      return OpenShared(message);
  }
}

std::unique_ptr<Publication> Port::OpenHand(const StateMessage& message) {
  const robot::HandSpec& spec = spec_.hands[message.hand];
  CheckFits(spec);
  std::size_t first_motor = spec_.motors.size();  // in motor order
  for (std::size_t i = 0; i < message.hand; ++i) first_motor += spec_.hands[i].motors.size();
  const auto encode = [first_motor](auto encoder) {
    return [first_motor, encoder = std::move(encoder)](const robot::RobotState& state,
                                                       auto* sent) mutable {
      encoder.Encode(std::span(state.motors).subspan(first_motor));
      *sent = encoder.message();
      return true;
    };
  };
  switch (robot::LawOf(spec).messages) {
    case robot::HandLaw::Messages::kMotors:
      return Open<unitree_go_msg_dds__MotorStates_>(message, encode(MotorStatesMessage(spec)));
    case robot::HandLaw::Messages::kRegisters:
      return Open<inspire_inspire_hand_state>(message, encode(RegisterStateMessage(spec)));
    case robot::HandLaw::Messages::kHand:
      break;
  }
  const std::size_t first_cell = FirstCell(message.hand);
  return Open<unitree_hg_msg_dds__HandState_>(
      message, [first_motor, first_cell, encoder = HandStateMessage(spec)](
                   const robot::RobotState& state, unitree_hg_msg_dds__HandState_* sent) mutable {
        encoder.Encode(std::span(state.motors).subspan(first_motor));
        encoder.EncodeTouch(TouchFrom(state, first_cell));
        *sent = encoder.message();
        return true;
      });
}

std::unique_ptr<Publication> Port::OpenTouch(const StateMessage& message) {
  return Open<inspire_inspire_hand_touch>(
      message,
      [first_cell = FirstCell(message.hand), encoder = TouchMessage(spec_.hands[message.hand])](
          const robot::RobotState& state, inspire_inspire_hand_touch* sent) mutable {
        encoder.Encode(TouchFrom(state, first_cell));
        *sent = encoder.message();
        return true;
      });
}

std::size_t Port::FirstCell(std::size_t hand) const {
  std::size_t first = 0;
  for (std::size_t i = 0; i < hand; ++i) first += robot::CellsOf(spec_.hands[i]);
  return first;
}

}  // namespace understudy::wire
