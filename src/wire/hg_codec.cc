#include "wire/hg_codec.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <span>

#include "robot/parallel_joint.h"
#include "wire/cells.h"
#include "wire/imu_codec.h"
#include "wire/message_crc.h"
#include "wire/motor_errors.h"
#include "wire/remote_codec.h"
#include "wire/rounded.h"
#include "wire/slots.h"

namespace understudy::wire {
namespace {

using MotorState = unitree_hg_msg_dds__MotorState_;

static_assert(std::size(unitree_hg_msg_dds__LowCmd_{}.motor_cmd) == kHgMotorSlots);
static_assert(std::size(unitree_hg_msg_dds__LowState_{}.motor_state) == kHgMotorSlots);
static_assert(std::size(unitree_hg_msg_dds__BmsState_{}.cell_vol) == kHgCells);

constexpr std::uint8_t kEnabled = 1;
constexpr double kVolStep = 0.5;    // V, public audit of a real G1; on other robots *assumed*
constexpr std::uint8_t kSoh = 100;  // percent, *assumed*
// BmsState_ of a real G1, public capture; on other robots *assumed*.
constexpr std::uint8_t kBmsVersionHigh = 1, kBmsVersionLow = 6, kBmsFn = 5;

void EncodeMotion(double q, double dq, double tau, MotorState* wire) {
  wire->q = static_cast<float>(q);
  wire->dq = static_cast<float>(dq);
  wire->tau_est = static_cast<float>(tau);
}

// Overwrites the serial pair's readings with those of its two motors.
void EncodePair(const robot::RobotState& state, const robot::RobotSpec& spec,
                const robot::ParallelJoint& joint, unitree_hg_msg_dds__LowState_* message) {
  const auto pitch = static_cast<std::size_t>(joint.pitch());
  const auto roll = static_cast<std::size_t>(joint.roll());
  const robot::MotorReading& p = state.motors[pitch];
  const robot::MotorReading& r = state.motors[roll];
  const robot::ParallelJoint::Motors q = joint.ToMotors({p.q, r.q});
  const robot::ParallelJoint::Motors dq = joint.ToMotors({p.dq, r.dq});
  const robot::ParallelJoint::Motors tau = joint.TorqueToMotors({p.tau, r.tau});
  EncodeMotion(q.b, dq.b, tau.b, &message->motor_state[SlotOf(spec.motors[pitch])]);
  EncodeMotion(q.a, dq.a, tau.a, &message->motor_state[SlotOf(spec.motors[roll])]);
}

}  // namespace

robot::Refusal Decode(const unitree_hg_msg_dds__LowCmd_& message, const robot::RobotSpec& spec,
                      robot::RobotCommand* command) {
  bool modes_known = true;
  const bool motor_space = message.mode_pr == static_cast<std::uint8_t>(robot::JointSpace::kMotors);
  command->motors.resize(spec.motors.size());
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const auto& wire = message.motor_cmd[SlotOf(spec.motors[i])];
    modes_known = modes_known && wire.mode <= kEnabled;
    command->motors[i] = DecodeMotor(wire);
    if (motor_space) command->motors[i].space = robot::JointSpace::kMotors;
  }

  if (message.crc != MessageCrc(message)) return robot::Refusal::kCrc;
  if (message.mode_machine != spec.mode_machine) return robot::Refusal::kModeMachine;
  if (message.mode_pr > static_cast<std::uint8_t>(robot::JointSpace::kMotors))
    return robot::Refusal::kModePr;
  if (!modes_known) return robot::Refusal::kMotorMode;
  return robot::Refusal::kNone;
}

void Encode(const robot::RobotState& state, const robot::RobotSpec& spec,
            unitree_hg_msg_dds__LowState_* message) {
  message->mode_pr = static_cast<std::uint8_t>(state.joint_space);
  message->mode_machine = static_cast<std::uint8_t>(spec.mode_machine);
  message->tick = static_cast<std::uint32_t>(state.tick_ms);
  EncodeImu(state.imu, &message->imu_state);

  const auto vol = static_cast<float>(kVolStep * std::round(state.battery.voltage / kVolStep));
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    const robot::MotorReading& motor = state.motors[i];
    MotorState& wire = message->motor_state[SlotOf(spec.motors[i])];
    wire.mode = kEnabled;
    EncodeMotion(motor.q, motor.dq, motor.tau, &wire);
    wire.temperature[0] = Rounded<std::int16_t>(motor.casing_c);
    wire.temperature[1] = Rounded<std::int16_t>(motor.winding_c);
    wire.vol = vol;
    wire.motorstate = ErrorsOf(motor, kHgMotorErrors);
  }
  if (state.joint_space == robot::JointSpace::kMotors) {
    for (const robot::ParallelSpec& pair : spec.parallel) {
      EncodePair(state, spec, robot::ParallelJoint(pair), message);
    }
  }
  const auto remote = EncodeRemote(state.remote);
  std::ranges::copy(remote, message->wireless_remote);
  message->crc = MessageCrc(*message);
}

void EncodeBms(const robot::RobotState& state, const robot::RobotSpec& spec,
               unitree_hg_msg_dds__BmsState_* message) {
  const robot::BatteryReading& battery = state.battery;
  for (std::size_t i = 0; i < static_cast<std::size_t>(spec.battery.cells); ++i) {
    message->cell_vol[i] = CellMillivolt(battery, spec.battery, i);
  }
  message->version_high = kBmsVersionHigh;
  message->version_low = kBmsVersionLow;
  message->fn = kBmsFn;
  // Of the pack and of the battery, mV: alike (*assumed*).
  message->bmsvoltage[0] = message->bmsvoltage[1] = Rounded<std::uint32_t>(1000 * battery.voltage);
  message->current = Rounded<std::int32_t>(1000 * battery.current);
  message->soc = Rounded<std::uint8_t>(100 * battery.soc, 0, 100);
  message->soh = kSoh;
  std::ranges::fill(message->temperature, Rounded<std::int16_t>(battery.temperature_c));
}

}  // namespace understudy::wire
