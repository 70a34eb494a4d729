// Delays commands by a number of steps.
#pragma once

#include <algorithm>
#include <cstddef>
#include <utility>
#include <vector>

#include "robot/robot_values.h"

namespace understudy::authority {

// A delay line. Allocates only in the constructor if all commands have as many motors as `start`.
class CommandDelay {
 public:
  // `start` is the output until the first command has passed.
  CommandDelay(std::size_t steps, const robot::RobotCommand& start)
      : out_(start), waiting_(steps, start) {}

  // Takes the present command and returns that of `steps` calls before. Valid until the next call.
  const robot::RobotCommand& Pass(const robot::RobotCommand& command) {
    if (waiting_.empty()) return command;
    std::swap(out_, waiting_[next_]);
    waiting_[next_] = command;
    next_ = (next_ + 1) % waiting_.size();
    return out_;
  }

  // Fills the delay with `start`, as at the beginning.
  void Restart(const robot::RobotCommand& start) { std::ranges::fill(waiting_, start); }

 private:
  robot::RobotCommand out_;
  std::vector<robot::RobotCommand> waiting_;  // a ring; the oldest is at next_
  std::size_t next_ = 0;
};

}  // namespace understudy::authority
