// Motors that follow commands some steps late.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "robot/robot_values.h"

namespace understudy::authority {

// Allocates in the constructor only, as long as every command is for as many motors as `start`.
class CommandDelay {
 public:
  // `start`: what motors follow until the first command has got through.
  CommandDelay(std::size_t steps, const robot::RobotCommand& start)
      : out_(start), waiting_(steps, start) {}

  // The command of `steps` calls ago for that of now. Valid until the next call.
  const robot::RobotCommand& Pass(const robot::RobotCommand& command) {
    if (waiting_.empty()) return command;
    std::swap(out_, waiting_[next_]);
    waiting_[next_] = command;
    next_ = (next_ + 1) % waiting_.size();
    return out_;
  }

  // Forgets what waits; `start` as at the beginning.
  void Restart(const robot::RobotCommand& start) { std::ranges::fill(waiting_, start); }

 private:
  robot::RobotCommand out_;
  std::vector<robot::RobotCommand> waiting_;  // a ring; the oldest is at next_
  std::size_t next_ = 0;
};

}  // namespace understudy::authority
