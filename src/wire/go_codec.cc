#include "wire/go_codec.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

#include "wire/cells.h"
#include "wire/imu_codec.h"
#include "wire/message_crc.h"
#include "wire/motor_errors.h"
#include "wire/remote_codec.h"
#include "wire/rounded.h"
#include "wire/slots.h"

namespace understudy::wire {
namespace {

static_assert(std::size(unitree_go_msg_dds__LowCmd_{}.motor_cmd) == kGoMotorSlots);
static_assert(std::size(unitree_go_msg_dds__LowState_{}.motor_state) == kGoMotorSlots);
static_assert(std::size(unitree_go_msg_dds__BmsState_{}.cell_vol) == kGoCells);

constexpr std::uint8_t kHead[] = {0xFE, 0xEF};
constexpr std::uint8_t kLowLevel = 0xFF;  // LowCmd's level_flag; LowState's is 0
constexpr std::uint8_t kServo = 0x01;
constexpr std::uint8_t kServoStrong = 0x0A;  // vendor, H1 basic services

// Values without a source are those of two complete LowStates of real Go2 (public captures, 2024-09
// and 2026-03). That other robots of the family send the same is *assumed*.
constexpr std::uint32_t kMotorRate = 602;  // seen 523..638, the same for all motors; unit unknown
constexpr std::uint8_t kBmsVersion[] = {1, 16};
constexpr std::uint8_t kDischarging = 8;  // vendor, Go2-W basic services
constexpr std::uint16_t kBmsCycles = 17;
constexpr double kMosWarmer_c = 2;           // mcu_ntc over bq_ntc; seen 1..4
constexpr std::uint8_t kNotCharging = 0x04;  // bits of bit_flag: vendor, Go2-W basic services
constexpr std::uint8_t kNoRemote = 0x20;
constexpr std::uint8_t kMotorSilent = 0x80;  // vendor, Go2 fault services
constexpr std::uint8_t kMcuSilent = 0x40;    // vendor, Go2 fault services
constexpr float kReel = 4 * 3.3F / 2048;     // A; 4 counts of the converter
constexpr double kBoardDrop = 1.28;          // V from pack to board; seen 1.13 and 1.42
constexpr double kBoardShare = 0.69;         // of the pack's current that the board sees

bool Knows(std::uint8_t mode) { return mode == 0 || mode == kServo || mode == kServoStrong; }

void EncodeBattery(const robot::BatteryReading& battery, const robot::BatterySpec& spec,
                   unitree_go_msg_dds__BmsState_* message) {
  message->version_high = kBmsVersion[0];
  message->version_low = kBmsVersion[1];
  message->status = kDischarging;
  message->soc = Rounded<std::uint8_t>(100 * battery.soc, 0, 100);
  message->current = Rounded<std::int32_t>(1000 * battery.current);
  message->cycle = kBmsCycles;
  std::ranges::fill(message->bq_ntc, Rounded<std::uint8_t>(battery.temperature_c, 0, 127));
  std::ranges::fill(message->mcu_ntc,
                    Rounded<std::uint8_t>(battery.temperature_c + kMosWarmer_c, 0, 127));
  for (std::size_t i = 0; i < static_cast<std::size_t>(spec.cells); ++i) {
    message->cell_vol[i] = CellMillivolt(battery, spec, i);
  }
}

}  // namespace

bool HeadIsUnset(const unitree_go_msg_dds__LowCmd_& message) {
  return message.head[0] == 0 && message.head[1] == 0 && message.level_flag == 0;
}

robot::Refusal Decode(const unitree_go_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command) {
  bool modes_known = true;
  command->motors.resize(spec.motors.size());
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto& wire = message.motor_cmd[SlotOf(spec.motors[i])];
    modes_known = modes_known && Knows(wire.mode);
    command->motors[i] = DecodeMotor(wire);
  }

  if (message.crc != MessageCrc(message)) return robot::Refusal::kCrc;
  const bool head_set = std::ranges::equal(message.head, kHead) && message.level_flag == kLowLevel;
  if (!head_set && !HeadIsUnset(message)) return robot::Refusal::kHead;
  if (!modes_known) return robot::Refusal::kMotorMode;
  return robot::Refusal::kNone;
}

std::uint8_t BottomFaults(const robot::RobotState& state) {
  const bool silent = std::ranges::any_of(state.motors, &robot::MotorReading::silent);
  return static_cast<std::uint8_t>((silent ? kMotorSilent : 0) |
                                   (state.board.mute ? kMcuSilent : 0));
}

void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_go_msg_dds__LowState_* message) {
  std::ranges::copy(kHead, message->head);
  EncodeImu(state.imu, &message->imu_state);
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorReading& motor = state.motors[i];
    auto& wire = message->motor_state[SlotOf(spec.motors[i])];
    wire.mode = kServo;
    wire.q = static_cast<float>(motor.q);
    wire.dq = static_cast<float>(motor.dq);
    wire.tau_est = static_cast<float>(motor.tau);
    // One temperature for casing and winding: the hotter one is *assumed*.
    wire.temperature = Rounded<std::uint8_t>(std::max(motor.casing_c, motor.winding_c), 0, 127);
    wire.lost = motor.lost;
    wire.reserve[0] = ErrorsOf(motor, kGoMotorErrors);
    wire.reserve[1] = motor.silent ? 0 : kMotorRate;
  }
  EncodeBattery(state.battery, spec.battery, &message->bms_state);

  const std::size_t feet = std::min(state.foot_force.size(), std::size(message->foot_force));
  for (std::size_t i = 0; i < feet; ++i) {
    message->foot_force[i] = FootCounts(state.foot_force[i], spec.foot_sensor);
  }

  message->tick = static_cast<std::uint32_t>(state.tick_ms);
  const auto remote = EncodeRemote(state.remote);
  std::ranges::copy(remote, message->wireless_remote);
  message->bit_flag = kNotCharging | BottomFaults(state);
  if (!state.remote.there) message->bit_flag |= kNoRemote;
  message->adc_reel = kReel;
  message->temperature_ntc1 = Rounded<std::uint8_t>(state.board.centre_c, 0, 127);
  message->temperature_ntc2 = Rounded<std::uint8_t>(state.board.charger_c, 0, 127);
  for (std::size_t i = 0; i < state.board.fan_rpm.size(); ++i) {
    message->fan_frequency[i] = Rounded<std::uint16_t>(state.board.fan_rpm[i], 0, 65535);
  }
  message->fan_frequency[3] = state.board.stalled;
  message->power_v = static_cast<float>(std::max(0.0, state.battery.voltage - kBoardDrop));
  message->power_a = static_cast<float>(kBoardShare * std::abs(state.battery.current));
  message->crc = MessageCrc(*message);
}

}  // namespace understudy::wire
