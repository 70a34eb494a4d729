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

namespace understudy {

// Commands wait in a queue; what is published is kept, in order.
class FakePort final : public RobotPort {
 public:
  struct Sample {
    RobotState state;
    Due due;
  };

  // Lets a command wait, with what the wire found wrong with it.
  void Send(const RobotCommand& command, Refusal wire = Refusal::kNone);
  // From now on one such command waits at every drain of the port. Taking it allocates nothing.
  void SendEveryTick(const RobotCommand& command) { steady_ = command; }
  // The same for rt/arm_sdk and rt/user_lowcmd: these wait until taken.
  void SendArms(const RobotCommand& command, double weight) { arms_.push_back({command, weight}); }
  void SendUser(const RobotCommand& command) { user_.push_back(command); }
  // The same for a hand: one that waits, and one that waits at every drain.
  void SendHand(std::size_t hand, const HandCommand& command, Refusal wire = Refusal::kNone);
  void SendHandsEveryTick(const HandCommand& command) { steady_hand_ = command; }
  // From now on only the last sample is kept; publishing one more then allocates nothing.
  void KeepTheLastOnly() { keep_all_ = false; }

  const std::vector<Sample>& samples() const { return samples_; }
  const Sample& last() const { return samples_.back(); }
  bool idle() const { return waiting_.empty(); }

  bool TakeCommand(RobotCommand* command, Refusal* wire) override;
  bool TakeArmCommand(RobotCommand* command, double* weight) override;
  bool TakeUserCommand(RobotCommand* command) override;
  bool TakeHandCommand(std::size_t hand, HandCommand* command, Refusal* wire) override;
  void Publish(const RobotState& state, const Due& due) override;
  int command_writers() override { return 1; }
  PortCounts counts() const override { return {}; }

 private:
  struct Waiting {
    RobotCommand command;
    Refusal wire;
  };

  struct WaitingHand {
    HandCommand command;
    Refusal wire;
  };

  struct WaitingArms {
    RobotCommand command;
    double weight;
  };

  std::deque<Waiting> waiting_;
  std::deque<WaitingArms> arms_;
  std::deque<RobotCommand> user_;
  std::array<std::deque<WaitingHand>, kMostHands> hands_;
  std::optional<HandCommand> steady_hand_;
  bool steady_hand_taken_ = false;  // in this drain
  std::optional<RobotCommand> steady_;
  bool steady_taken_ = false;  // in this drain
  bool keep_all_ = true;
  std::vector<Sample> samples_;
};

}  // namespace understudy

#endif  // UNDERSTUDY_TESTS_SUPPORT_FAKE_PORT_H_
