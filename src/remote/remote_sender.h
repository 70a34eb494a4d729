// Decides when to send the held keys and sticks to the robot.
#pragma once

#include <cstdint>
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

// Returns a number for the first press of this process that others will hardly use.
std::int64_t FirstPress();

// Sends changes, and repeats while keys or sticks are held. Sends nothing otherwise, so that other
// programs can use the same remote. Times are of any steady clock [s].
class RemoteSender {
 public:
  // Sends the values of the request remote.set: what is held, until it is released or the robot has
  // heard nothing for a while.
  using Send = std::function<void(const nlohmann::json& values)>;

  // Presses are numbered from `press`, best by another number than other programs use.
  explicit RemoteSender(Send send, std::int64_t press = 0)
      : send_(std::move(send)), press_(press) {}

  // Sets the simulated seconds per second, as requests count simulated time.
  void set_speed(double speed) { speed_ = speed; }

  // Call it at least every kLeastPeriod.
  void Hold(const robot::RemoteReading& reading, double t);
  void LetGo(double t);

 private:
  void Tell(const robot::RemoteReading& reading, double t);

  Send send_;
  std::int64_t press_;
  double speed_ = 1;
  robot::RemoteReading told_;
  double told_at_ = 0;
  bool told_any_ = false;
};

}  // namespace understudy::remote
