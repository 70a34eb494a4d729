// What a running robot says of itself, as plain values, and the board it is read from.
#ifndef UNDERSTUDY_EMULATOR_STATUS_H_
#define UNDERSTUDY_EMULATOR_STATUS_H_

#include <algorithm>
#include <array>
#include <cstdint>
#include <mutex>
#include <string_view>

#include "authority/command_gate.h"
#include "emulator/request_notes.h"
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
  robot::Refusal last_refusal = robot::Refusal::kNone;
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

struct Status {
  bool ready = false;     // the first LowState is out
  bool silenced = false;  // another robot appeared and we stopped sending
  double time = 0;        // simulated s
  std::int64_t steps = 0;
  double speed = 1;  // wanted; 0 = as fast as possible
  bool paused = false;
  std::int64_t steps_left = 0;  // to be made although paused
  time::PaceReading pace;
  time::Histogram ticks;  // wall time of each, since start
  services::ServiceCounts services;
  authority::GateState gate = authority::GateState::kStart;
  std::array<char, 32> motion_service{};  // alias of the one that is on; "" when none is
  robot::MotionState motion;              // of that service
  double arm_weight = 0;                  // of rt/arm_sdk, 0..1
  robot::RemoteReading remote;
  std::array<double, 3> stick_wish{};  // forward, left m/s, turn rad/s that the sticks ask for
  authority::GateCounts commands;
  robot::Refusal last_refusal = robot::Refusal::kNone;
  authority::GateCounts arm_commands;   // of rt/arm_sdk
  authority::GateCounts user_commands;  // of rt/user_lowcmd
  std::array<HandStatus, robot::kMostHands> hands;
  robot::PortCounts port;
  int command_writers = 0;
  std::uint64_t published = 0;  // LowState samples
  std::uint64_t divergences = 0;
  RequestNotes requests;        // of people, not of a script
  std::size_t script_done = 0;  // events of the script that are over
  std::size_t script_refused = 0;
  std::array<char, 128> script_refusal{};  // the last one: where it stands and why; "" for none
  double crane_tension = 0;                // N
  double crane_length = 0;                 // m
  bool crane_attached = false;
  bool clamped = false;
  double base_height = 0;  // m
  double tilt = 0;         // rad between the base's up and the world's
  RecordingStatus recording;
};

// Cut to what there is room for, with a zero at the end.
template <std::size_t kRoom>
void Copy(std::string_view text, std::array<char, kRoom>* to) {
  *std::copy_n(text.begin(), std::min(text.size(), kRoom - 1), to->begin()) = '\0';
}

// What came by that topic.
inline const authority::GateCounts& CommandCounts(const Status& status, std::size_t topic) {
  if (topic == robot::kLowCmdTopic) return status.commands;
  if (topic == robot::kArmSdkTopic) return status.arm_commands;
  if (topic == robot::kUserLowCmdTopic) return status.user_commands;
  return status.hands[topic - robot::kFirstHandTopic].commands;
}

// One writer, the tick, which never waits: a post that finds the board being read is left out. Any
// number of readers.
class StatusBoard {
 public:
  // The tick. Copies plain values only.
  void Post(const Status& status) {
    if (const std::unique_lock lock(mutex_, std::try_to_lock); lock) status_ = status;
  }
  // Any thread. Default values before the first post.
  Status Read() const {
    const std::lock_guard lock(mutex_);
    return status_;
  }

 private:
  mutable std::mutex mutex_;
  Status status_;
};

}  // namespace understudy::emulator

#endif  // UNDERSTUDY_EMULATOR_STATUS_H_
