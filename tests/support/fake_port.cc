#include "tests/support/fake_port.h"

namespace understudy::test {

void FakePort::Send(const robot::RobotCommand& command, robot::Refusal wire) {
  waiting_.push_back({command, wire});
}

bool FakePort::TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) {
  if (!waiting_.empty()) {
    *command = waiting_.front().command;
    *wire = waiting_.front().wire;
    waiting_.pop_front();
    return true;
  }
  steady_taken_ = steady_.has_value() && !steady_taken_;
  if (!steady_taken_) return false;
  *command = *steady_;
  *wire = robot::Refusal::kNone;
  return true;
}

void FakePort::SendHand(std::size_t hand, const robot::HandCommand& command, robot::Refusal wire) {
  hands_[hand].push_back({command, wire});
}

bool FakePort::TakeHandCommand(std::size_t hand, robot::HandCommand* command,
                               robot::Refusal* wire) {
  std::deque<WaitingHand>& waiting = hands_[hand];
  if (!waiting.empty()) {
    *command = waiting.front().command;
    *wire = waiting.front().wire;
    waiting.pop_front();
    return true;
  }
  steady_hand_taken_ = steady_hand_.has_value() && !steady_hand_taken_;
  if (!steady_hand_taken_) return false;
  *command = *steady_hand_;
  *wire = robot::Refusal::kNone;
  return true;
}

bool FakePort::TakeArmCommand(robot::RobotCommand* command, double* weight) {
  if (arms_.empty()) return false;
  *command = arms_.front().command;
  *weight = arms_.front().weight;
  arms_.pop_front();
  return true;
}

bool FakePort::TakeUserCommand(robot::RobotCommand* command) {
  if (user_.empty()) return false;
  *command = user_.front();
  user_.pop_front();
  return true;
}

void FakePort::Publish(const robot::RobotState& state, const wire::Due& due) {
  if (keep_all_ || samples_.empty()) {
    samples_.push_back({state, due});
  } else {
    samples_.back().state = state;
    samples_.back().due = due;
  }
}

}  // namespace understudy::test
