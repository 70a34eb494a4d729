#include "assembly/command_port.h"

namespace understudy::assembly {

bool CommandPort::Take(std::size_t topic, robot::RobotCommand* command, robot::Refusal* form) {
  std::deque<robot::RobotCommand>& given = given_[topic];
  if (given.empty()) return false;
  *command = std::move(given.front());
  given.pop_front();
  ++heard_[topic];
  *form = robot::Refusal::kNone;
  return true;
}

}  // namespace understudy::assembly
