// The status of a running robot as plain values, and the board that passes it to other threads.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <string_view>

#include "authority/command_gate.h"
#include "authority/intake.h"
#include "emulator/mailbox.h"
#include "robot/command_topics.h"
#include "robot/hand_law.h"
#include "robot/port_counts.h"
#include "robot/power.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"
#include "services/service_port.h"
#include "time/pacer.h"

namespace understudy::emulator {

// Of one hand.
struct HandStatus {
  std::array<char, 16> name{};  // "" if the robot has no such hand
  authority::GateCounts commands;
};

// What presses on one hand.
struct HandForce {
  std::array<char, 16> name{};  // robot::HandNames; "" if the robot has no such hand
  double force = 0;             // N
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
  std::uint64_t bytes = 0;       // in the file
  std::uint64_t dropped = 0;     // moments lost because the recorder was too slow
  std::array<char, 256> file{};  // cut to fit; "" if it is off
};

// The part of the status that the loop around the tick knows.
struct LoopReading {
  bool ready = false;  // the first LowState has been published
  time::PaceReading pace;
  time::Histogram ticks;  // wall time of each, since start
  RecordingStatus recording;
};

// The present state of the world and of one of its robots, filled in by World::status().
struct Status {
  LoopReading loop;
  robot::PowerState power = robot::PowerState::kOn;
  double boots_for = 0;   // simulated s until it has booted
  bool silenced = false;  // another robot appeared and publishing has stopped
  double time = 0;        // simulated s
  std::int64_t steps = 0;
  double speed = 1;  // wanted; 0 = as fast as possible
  bool paused = false;
  std::int64_t steps_left = 0;  // steps to make while paused
  services::ServiceCounts services;
  authority::GateState gate = authority::GateState::kStart;
  std::array<char, 32> motion_service{};  // alias of the one that is on; "" if none is
  robot::MotionState motion;              // of that service
  double arm_weight = 0;                  // of rt/arm_sdk, 0..1
  double hand_weight = 0;                 // of rt/hand_sdk, 0..1
  robot::RemoteReading remote;
  std::array<double, 3> stick_wish{};  // forward, left m/s, turn rad/s from the sticks
  authority::GateCounts commands;
  authority::GateCounts arm_commands;   // of rt/arm_sdk
  authority::GateCounts user_commands;  // of rt/user_lowcmd
  authority::GateCounts hand_commands;  // of rt/hand_sdk
  std::array<HandStatus, robot::kMostHands> hands;
  std::array<HandForce, robot::kMostHandNames> hand_forces;
  robot::PortCounts port;
  int command_writers = 0;
  std::uint64_t published = 0;  // published LowState samples
  std::uint64_t divergences = 0;
  std::size_t script_done = 0;  // events of the script that are over
  std::size_t script_refused = 0;
  std::size_t script_waiting = 0;            // events that wait for a condition
  std::array<char, 120> script_where{};      // file and line of the first of them
  std::array<char, 120> script_waits_for{};  // its condition
  double crane_tension = 0;                  // N
  double crane_length = 0;                   // m
  bool crane_attached = false;
  bool clamped = false;
  double base_height = 0;  // m
  double tilt = 0;         // rad between the z axes of base and world
};

// Returns the counts of a command topic.
inline const authority::GateCounts& CommandCounts(const Status& status, std::size_t topic) {
  if (topic == robot::kLowCmdTopic) return status.commands;
  if (topic == robot::kArmSdkTopic) return status.arm_commands;
  if (topic == robot::kUserLowCmdTopic) return status.user_commands;
  if (topic == robot::kHandSdkTopic) return status.hand_commands;
  return status.hands[topic - robot::kFirstHandTopic].commands;
}

// Passes the newest status from the tick to any number of readers. No side waits.
class StatusBoard {
 public:
  // For the tick. Copies plain values.
  void Post(const Status& status) {
    Status* slot = newest_.Claim();
    if (slot == nullptr) return;  // cannot happen: more readings than threads
    *slot = status;
    newest_.Post();
  }
  // For any thread. Returns default values before the first post.
  Status Read() const { return *newest_.Newest(); }

 private:
  Mailbox<Status> newest_;
};

}  // namespace understudy::emulator
