// What a running robot says of itself, as plain values, and the board it is read from.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "authority/command_gate.h"
#include "authority/intake.h"
#include "emulator/mailbox.h"
#include "robot/command_topics.h"
#include "robot/port_counts.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "services/service_port.h"
#include "time/pacer.h"

namespace understudy::emulator {

// Of one hand.
struct HandStatus {
  std::array<char, 16> name{};  // "" where the robot has no such hand
  authority::GateCounts commands;
};

enum class RecordingState : std::uint8_t { kOff, kOn, kFailed };

// The word that the control plane uses.
constexpr std::string_view Name(RecordingState state) {
  constexpr std::array<std::string_view, 3> kNames = {"off", "on", "failed"};
  return kNames[static_cast<std::size_t>(state)];
}

struct RecordingStatus {
  RecordingState state = RecordingState::kOff;
  std::uint64_t messages = 0;
  std::uint64_t bytes = 0;    // in the file
  std::uint64_t dropped = 0;  // moments that are not in it, since its thread was too far behind
};

// What only the loop around the tick knows.
struct LoopReading {
  bool ready = false;  // the first LowState is out
  time::PaceReading pace;
  time::Histogram ticks;  // wall time of each, since start
  RecordingStatus recording;
};

// What is so now, filled in by World::status() alone.
struct Status {
  LoopReading loop;
  bool silenced = false;  // another robot appeared and we stopped sending
  double time = 0;        // simulated s
  std::int64_t steps = 0;
  double speed = 1;  // wanted; 0 = as fast as possible
  bool paused = false;
  std::int64_t steps_left = 0;  // to be made although paused
  services::ServiceCounts services;
  authority::GateState gate = authority::GateState::kStart;
  std::array<char, 32> motion_service{};  // alias of the one that is on; "" when none is
  robot::MotionState motion;              // of that service
  double arm_weight = 0;                  // of rt/arm_sdk, 0..1
  robot::RemoteReading remote;
  std::array<double, 3> stick_wish{};  // forward, left m/s, turn rad/s that the sticks ask for
  authority::GateCounts commands;
  authority::GateCounts arm_commands;   // of rt/arm_sdk
  authority::GateCounts user_commands;  // of rt/user_lowcmd
  std::array<HandStatus, robot::kMostHands> hands;
  robot::PortCounts port;
  int command_writers = 0;
  std::uint64_t published = 0;  // LowState samples
  std::uint64_t divergences = 0;
  std::size_t script_done = 0;  // events of the script that are over
  std::size_t script_refused = 0;
  double crane_tension = 0;  // N
  double crane_length = 0;   // m
  bool crane_attached = false;
  bool clamped = false;
  double base_height = 0;  // m
  double tilt = 0;         // rad between the base's up and the world's
};

// What came by that topic.
inline const authority::GateCounts& CommandCounts(const Status& status, std::size_t topic) {
  if (topic == robot::kLowCmdTopic) return status.commands;
  if (topic == robot::kArmSdkTopic) return status.arm_commands;
  if (topic == robot::kUserLowCmdTopic) return status.user_commands;
  return status.hands[topic - robot::kFirstHandTopic].commands;
}

// One writer, the tick; any number of readers. None waits for another.
class StatusBoard {
 public:
  // The tick. Copies plain values only.
  void Post(const Status& status) {
    Status* slot = newest_.Claim();
    if (slot == nullptr) return;  // more are reading at this moment than there are threads
    *slot = status;
    newest_.Post();
  }
  // Any thread. Default values before the first post.
  Status Read() const { return *newest_.Newest(); }

 private:
  Mailbox<Status> newest_;
};

}  // namespace understudy::emulator
