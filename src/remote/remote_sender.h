// Decides when to tell the robot what is held.
#pragma once

#include <functional>
#include <utility>

#include <nlohmann/json.hpp>

#include "robot/robot_values.h"

namespace understudy::remote {

// What is held is let go by the robot when it has not heard of it for so long [s, wall clock];
// *assumed*: short for a robot that walks, long for a program that was held up.
inline constexpr double kLetGoAfter = 0.5;
inline constexpr double kRenewEvery = 0.1;    // s; four may be lost
inline constexpr double kLeastPeriod = 0.01;  // s: changes are told at 100 Hz at most

// Tells changes, and again and again what is held; nothing while nothing is, so that others can
// use the same remote. Times are of any steady clock [s].
class RemoteSender {
 public:
  // What is held, and the simulated seconds after which it is to be let go.
  using Send = std::function<void(const robot::RemoteReading&, double seconds)>;

  explicit RemoteSender(Send send) : send_(std::move(send)) {}

  // Simulated seconds per second: requests count in the former.
  void set_speed(double speed) { speed_ = speed; }

  // To be called more often than kLeastPeriod.
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

// The values of the request remote.set.
nlohmann::json ValuesOf(const robot::RemoteReading& reading, double seconds);

}  // namespace understudy::remote
