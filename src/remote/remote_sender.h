// Decides when to send the held keys and sticks to the robot.
#pragma once

#include <functional>
#include <utility>

#include <nlohmann/json.hpp>

#include "robot/robot_values.h"

namespace understudy::remote {

// The robot releases all keys after this time [s, wall clock] without a message; *assumed*: short
// for a robot that walks, long for a program that was delayed.
inline constexpr double kLetGoAfter = 0.5;
inline constexpr double kRenewEvery = 0.1;    // s; four may be lost
inline constexpr double kLeastPeriod = 0.01;  // s: changes are sent at 100 Hz at most

// Sends changes, and repeats while keys or sticks are held. Sends nothing otherwise, so that other
// programs can use the same remote. Times are of any steady clock [s].
class RemoteSender {
 public:
  // Sends the held keys and sticks, and the simulated seconds after which the robot releases them.
  using Send = std::function<void(const robot::RemoteReading&, double seconds)>;

  explicit RemoteSender(Send send) : send_(std::move(send)) {}

  // Sets the simulated seconds per second, as requests count simulated time.
  void set_speed(double speed) { speed_ = speed; }

  // Call it at least every kLeastPeriod.
  void Hold(const robot::RemoteReading& reading, double t);
  void LetGo(double t);

 private:
  void Tell(const robot::RemoteReading& reading, double t);

  Send send_;
  double speed_ = 1;
  robot::RemoteReading told_;
  double told_at_ = 0;
  bool told_any_ = false;
};

// Returns the values of the request remote.set.
nlohmann::json ValuesOf(const robot::RemoteReading& reading, double seconds);

}  // namespace understudy::remote
