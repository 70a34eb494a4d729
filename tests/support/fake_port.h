// A port without a wire.
#ifndef UNDERSTUDY_TESTS_SUPPORT_FAKE_PORT_H_
#define UNDERSTUDY_TESTS_SUPPORT_FAKE_PORT_H_

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>
#include <vector>

#include "robot/robot_spec.h"
#include "wire/robot_port.h"

namespace understudy::test {

// Commands wait in a queue; what is published is kept, in order.
class FakePort final : public wire::RobotPort {
 public:
  struct Sample {
    robot::RobotState state;
    wire::Due due;
  };

  // Lets a command wait, with what the wire found wrong with it.
  void Send(const robot::RobotCommand& command, robot::Refusal wire = robot::Refusal::kNone);
  // From now on one such command waits at every drain of the port. Taking it allocates nothing.
  void SendEveryTick(const robot::RobotCommand& command) { steady_ = command; }
  // The same for rt/arm_sdk and rt/user_lowcmd: these wait until taken.
  void SendArms(const robot::RobotCommand& command, double weight) {
    arms_.push_back({command, weight});
  }
  void SendUser(const robot::RobotCommand& command) { user_.push_back(command); }
  // The same for a hand: one that waits, and one that waits at every drain.
  void SendHand(std::size_t hand, const robot::HandCommand& command,
                robot::Refusal wire = robot::Refusal::kNone);
  void SendHandsEveryTick(const robot::HandCommand& command) { steady_hand_ = command; }
  // From now on only the last sample is kept; publishing one more then allocates nothing.
  void KeepTheLastOnly() { keep_all_ = false; }

  const std::vector<Sample>& samples() const { return samples_; }
  const Sample& last() const { return samples_.back(); }
  bool idle() const { return waiting_.empty(); }

  bool TakeCommand(robot::RobotCommand* command, robot::Refusal* wire) override;
  bool TakeArmCommand(robot::RobotCommand* command, double* weight) override;
  bool TakeUserCommand(robot::RobotCommand* command) override;
  bool TakeHandCommand(std::size_t hand, robot::HandCommand* command,
                       robot::Refusal* wire) override;
  void Publish(const robot::RobotState& state, const wire::Due& due) override;
  int command_writers() override { return 1; }
  robot::PortCounts counts() const override { return {}; }

 private:
  struct Waiting {
    robot::RobotCommand command;
    robot::Refusal wire;
  };

  struct WaitingHand {
    robot::HandCommand command;
    robot::Refusal wire;
  };

  struct WaitingArms {
    robot::RobotCommand command;
    double weight;
  };

  std::deque<Waiting> waiting_;
  std::deque<WaitingArms> arms_;
  std::deque<robot::RobotCommand> user_;
  std::array<std::deque<WaitingHand>, robot::kMostHands> hands_;
  std::optional<robot::HandCommand> steady_hand_;
  bool steady_hand_taken_ = false;  // in this drain
  std::optional<robot::RobotCommand> steady_;
  bool steady_taken_ = false;  // in this drain
  bool keep_all_ = true;
  std::vector<Sample> samples_;
};

}  // namespace understudy::test

#endif  // UNDERSTUDY_TESTS_SUPPORT_FAKE_PORT_H_
