// Tests what the ports of both families have in common.
#include "wire/port.h"

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/bus/garbage_writer.h"
#include "tests/support/allocations.h"
#include "tests/support/new_domain.h"
#include "tests/wire/client.h"
#include "tests/wire/go_command.h"
#include "tests/wire/robots.h"
#include "wire/message_crc.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

struct Go {
  using LowCmd = unitree_go_msg_dds__LowCmd_;
  static constexpr auto& kLowCmd = kGoLowCmd;
  static constexpr int kSlots = 20;
  static robot::RobotSpec Robot() { return GoRobot(); }
  // Sets one motor, the one with index 1.
  static LowCmd Command(float q) {
    LowCmd message = InitialGoCommand();
    message.motor_cmd[4].q = q;
    message.crc = MessageCrc(message);
    return message;
  }
};

struct Hg {
  using LowCmd = unitree_hg_msg_dds__LowCmd_;
  static constexpr auto& kLowCmd = kHgLowCmd;
  static constexpr int kSlots = 35;
  static robot::RobotSpec Robot() { return HgRobot(); }
  static LowCmd Command(float q) {
    LowCmd message{};
    message.mode_machine = 5;
    message.motor_cmd[4].mode = 1;
    message.motor_cmd[4].q = q;
    message.crc = MessageCrc(message);
    return message;
  }
};

template <typename Family>
class PortTest : public testing::Test {
 protected:
  robot::RobotSpec spec_ = Family::Robot();
  robot::RobotCommand command_ = CommandOf(spec_);
  robot::Refusal wire_ = robot::Refusal::kNone;
};

using Families = testing::Types<Go, Hg>;
TYPED_TEST_SUITE(PortTest, Families);

TYPED_TEST(PortTest, HasNoCommandBeforeTheFirst) {
  const bus::Participant participant("lo", test::NewDomain());
  Port port(participant, this->spec_, kTimestep);
  EXPECT_EQ(port.command_writers(), 0);
  EXPECT_FALSE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
}

TYPED_TEST(PortTest, CountsTheCommandsThatNewerOnesReplaced) {
  const bus::Participant participant("lo", test::NewDomain());
  Port port(participant, this->spec_, kTimestep);
  bus::Writer<typename TypeParam::LowCmd> client(participant, TypeParam::kLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(client.Write(TypeParam::Command(static_cast<float>(i))));
  EXPECT_EQ(port.TakeLost(robot::kLowCmdTopic), 4U);
  EXPECT_EQ(port.TakeLost(robot::kLowCmdTopic), 0U);
  ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
  EXPECT_EQ(this->command_.motors[1].q, 4);
}

TYPED_TEST(PortTest, CountsNoneAsLostWhileTimeStandsStill) {
  const bus::Participant participant("lo", test::NewDomain());
  Port port(participant, this->spec_, kTimestep);
  bus::Writer<typename TypeParam::LowCmd> client(participant, TypeParam::kLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  for (int i = 0; i < 20; ++i) {
    ASSERT_TRUE(client.Write(TypeParam::Command(static_cast<float>(i))));
    port.KeepNewest();
  }
  EXPECT_EQ(port.TakeLost(robot::kLowCmdTopic), 0U);
  ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
  EXPECT_EQ(this->command_.motors[1].q, 4);
}

TYPED_TEST(PortTest, TakesCommandsOldestFirstAndTellsTheBrokenOne) {
  const bus::Participant participant("lo", test::NewDomain());
  Port port(participant, this->spec_, kTimestep);
  bus::Writer<typename TypeParam::LowCmd> client(participant, TypeParam::kLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  ASSERT_TRUE(client.Write(TypeParam::Command(1)));
  auto broken = TypeParam::Command(2);
  broken.crc ^= 1;
  ASSERT_TRUE(client.Write(broken));

  ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
  EXPECT_EQ(this->wire_, robot::Refusal::kNone);
  EXPECT_EQ(this->command_.motors[1].q, 1);
  ASSERT_TRUE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
  EXPECT_EQ(this->wire_, robot::Refusal::kCrc);
  EXPECT_EQ(this->command_.motors[1].q, 2);
  EXPECT_FALSE(port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_));
}

TYPED_TEST(PortTest, AllocatesNothingInATick) {
  const bus::Participant participant("lo", test::NewDomain());
  Port port(participant, this->spec_, kTimestep);
  bus::Writer<typename TypeParam::LowCmd> client(participant, TypeParam::kLowCmd);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  const robot::RobotState state = StateOf(this->spec_);
  const auto message = TypeParam::Command(1);
  const std::uint64_t before = test::Allocations();
  client.Write(message);
  const bool taken = port.Take(robot::kLowCmdTopic, &this->command_, &this->wire_);
  port.Publish(state, 0);
  const std::uint64_t after = test::Allocations();
  EXPECT_TRUE(taken);
  EXPECT_EQ(after - before, 0);
}

TYPED_TEST(PortTest, RefusesARobotThatDoesNotFit) {
  const bus::Participant participant("lo", test::NewDomain());
  this->spec_.motors.back().slot = TypeParam::kSlots;
  EXPECT_THROW(Port(participant, this->spec_, kTimestep), ModelError);
}

TEST(PortTest, TakesBytesOfAnotherTypeForARefusedCommand) {
  const int domain = test::NewDomain(), alias = test::NewDomain();
  const bus::Participant participant("lo", domain);
  const robot::RobotSpec spec = GoRobot();
  Port port(participant, spec, kTimestep);
  const bus::Entity network = bus::JoinOverTheNetwork(domain, alias);
  const bus::Stranger stranger(alias);
  const bus::GarbageWriter garbage(stranger, kGoLowCmd.name, *kGoLowCmd.descriptor);
  ASSERT_TRUE(test::Eventually([&] { return port.command_writers() == 1; }));
  robot::RobotCommand command = CommandOf(spec);
  robot::Refusal form = robot::Refusal::kNone;
  const auto taken = [&] {
    garbage.Send();
    return port.Take(robot::kLowCmdTopic, &command, &form);
  };
  EXPECT_TRUE(test::Eventually(taken));
  EXPECT_EQ(form, robot::Refusal::kUndecoded);
}

}  // namespace
}  // namespace understudy::wire
