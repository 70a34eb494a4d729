// The events of one robot.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "authority/command_router.h"
#include "emulator/events.h"
#include "robot/battery.h"
#include "robot/fault_bank.h"
#include "robot/motor.h"
#include "robot/port_counts.h"
#include "robot/power.h"
#include "robot/protection.h"
#include "robot/refusal.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "services/service_port.h"

namespace understudy::emulator {

// Adds events to a ring. Remembers the last value of what it compares, so that no other part has
// to. Does not allocate after the first call of a service.
class RobotEvents {
 public:
  // What can change in many places, by time alone too.
  struct Present {
    const authority::CommandRouter& router;
    robot::PowerState power;
    bool hears;  // whether the robot takes commands: while it is off, no service is reported
    std::uint16_t keys;
  };

  // `index` is the robot's number in the world. `spec` and `ring` must outlive it.
  RobotEvents(const robot::RobotSpec& spec, std::uint8_t index, EventRing* ring);

  // Adds the events of a robot's start.
  void Begin(const Present& now);
  // Add events for what has changed since the last call.
  void Compare(const Present& now);
  void CompareHolds(bool on_crane, bool clamped);
  void CompareHeat(const robot::MotorBank& motors);
  void CompareBattery(const robot::Battery& battery);

  void Add(EventKind kind, const std::array<double, 4>& numbers = {}, std::string_view text = {}) {
    ring_->Add(kind, index_, numbers, text);
  }
  // `state` is the id of the motion service's state.
  void AddCall(const services::Call& call, int state);
  // A command of that topic: `wire` is wrong with its form, `refusal` why it is not followed.
  void AddCommand(std::size_t topic, robot::Refusal wire, robot::Refusal refusal,
                  const authority::GateCounts& counts);
  // A taken command of a topic. Tells the first of rt/lowcmd that asks a joint for an angle, and
  // the first of each topic that holds some joints and leaves others without gains and torque;
  // rt/arm_sdk and rt/hand_sdk take a joint from another, so that kd alone does not hold it.
  // `state` is the last sample, empty before the first one.
  void AddTaken(std::size_t topic, const robot::RobotCommand& command,
                const robot::RobotState& state);
  // A fault of those that `bank` knows, which begins or is over.
  void AddFault(const robot::FaultBank& bank, const robot::Fault& fault, bool on);
  void AddNews(const robot::PortNews& news);
  // `service` is the motion service that would heed it.
  void AddUnheeded(const authority::Unheeded& unheeded, const robot::MotionState& state,
                   std::string_view service);

 private:
  enum class MotorHeat : std::uint8_t { kFine, kDerated, kTripped };

  // A motor that a topic moves, by its place in the topic's commands.
  struct Moved {
    std::size_t index;
    const robot::MotorSpec* motor;
  };

  void AddJump(const robot::RobotCommand& command, const robot::RobotState& state);
  void AddUnheld(std::size_t topic, const robot::RobotCommand& command);
  template <class Value>
  void CompareValue(EventKind kind, Value now, Value* last);
  void CompareDangers(const std::array<robot::DangerReading, robot::kDangers>& dangers);

  std::uint8_t index_;
  const robot::ThermalSpec* thermal_;
  std::vector<std::string> topics_;  // of commands
  std::vector<const robot::MotorSpec*> motors_;
  std::vector<std::vector<Moved>>
      moved_;  // by topic; empty once an event has said what nothing holds
  EventRing* ring_;

  // What was reported last.
  authority::GateState gate_ = authority::GateState::kStart;
  // Lives as long as the owner's services; nullopt while the robot hears nothing.
  std::optional<std::string_view> service_;
  int motion_id_ = 0, motion_mode_ = 0;
  std::string_view motion_name_;
  std::uint16_t keys_ = 0;
  bool on_crane_ = false;
  bool clamped_ = false;
  std::array<std::uint64_t, robot::kMostCommandTopics> timeouts_{};
  std::vector<MotorHeat> heat_;  // motor order
  robot::PowerState power_ = robot::PowerState::kOn;
  robot::CutOff cut_off_ = robot::CutOff::kNone;
  bool low_battery_ = false;
  bool asked_ = false;  // a command has asked a joint for an angle
  std::array<robot::Protection, robot::kDangers> dangers_{};
};

}  // namespace understudy::emulator
