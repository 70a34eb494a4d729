#include "authority/command_router.h"

#include <cmath>

#include <gtest/gtest.h>

namespace understudy::authority {
namespace {

constexpr double kService = 7, kLowCmd = 1, kArms = 3, kUser = 5, kStartTorque = -1;

// Torque 7 on every motor, and a list of what it was asked for.
class RecordingMotion final : public Motion {
 public:
  RecordingMotion(std::vector<MotionGoal>* asked, bool walks) : asked_(asked), walks_(walks) {}
  void Start(const MotionInput&) override { state_ = 0; }
  MotionVerdict Ask(const MotionGoal& goal) override {
    asked_->push_back(goal);
    if (std::holds_alternative<goal::Damp>(goal)) state_ = 1;
    if (std::holds_alternative<goal::SetFsm>(goal)) return MotionVerdict::kUnable;
    if (std::holds_alternative<goal::Sit>(goal)) return MotionVerdict::kNotNow;
    const auto* move = std::get_if<goal::Move>(&goal);
    return move != nullptr && !walks_ ? MotionVerdict::kUnable : MotionVerdict::kTaken;
  }
  void Step(const MotionInput&, double, robot::RobotCommand* command) override {
    for (robot::MotorCommand& motor : command->motors) motor = {.enabled = true, .tau = kService};
  }
  robot::MotionState state() const override { return {.id = state_}; }

 private:
  std::vector<MotionGoal>* asked_;
  bool walks_;
  int state_ = 0;
};

robot::RobotCommand Of(double tau) { return {.motors = {2, {.enabled = true, .tau = tau}}}; }

class CommandRouterTest : public ::testing::Test {
 protected:
  CommandRouterTest() {
    for (const int slot : {0, 1}) spec_.motors.push_back({.joint = "", .slot = slot});
    spec_.services = {{.name = "sport", .alias = "ai"}};
    spec_.arm_sdk.slots = {1};
    spec_.remote.chords = {{.keys = "L2+R2", .does = "debug"},
                           {.keys = "L2+B", .does = "damp"},
                           {.keys = "L2+Y", .does = "zero_torque", .from = {1}}};
    spec_.remote.speed = {1, 0.5, 2};
  }
  void Make() {
    router_ = std::make_unique<CommandRouter>(
        spec_, GateConfig{}, config_, Of(kStartTorque),
        [this](std::string_view) { return std::make_unique<RecordingMotion>(&asked_, walks_); });
  }
  // Torques of both motors in a tick of the service, or in one between.
  std::pair<double, double> Torques(bool service_due = true) {
    input_.time += 0.001;
    const robot::RobotCommand& command = router_->Current(input_, service_due, 0.002);
    return {command.motors[0].tau, command.motors[1].tau};
  }
  robot::Refusal Offer() { return OfferTo(robot::kLowCmdTopic, Of(kLowCmd)); }
  robot::Refusal OfferTo(std::size_t topic, const robot::RobotCommand& command,
                         robot::Refusal form = robot::Refusal::kNone) {
    return router_->Offer(topic, command, form, input_.time);
  }
  robot::Refusal OfferArms(robot::RobotCommand command, double weight) {
    command.weight = weight;
    return OfferTo(robot::kArmSdkTopic, command);
  }
  robot::Refusal OfferUser() { return OfferTo(robot::kUserLowCmdTopic, Of(kUser)); }
  std::uint64_t Refused(std::size_t topic, robot::Refusal refusal) const {
    return router_->counts(topic).refused[static_cast<std::size_t>(refusal)];
  }
  void Press(const char* keys) {
    router_->Obey({.there = true, .keys = *RemoteKeysOf(keys)}, input_.time);
    router_->Obey({.there = true}, input_.time);
  }
  // What the robot does not do of that chord.
  std::optional<Unheeded> UnheededOf(const char* keys) {
    router_->Obey({.there = true, .keys = *RemoteKeysOf(keys)}, input_.time);
    const std::optional<Unheeded> unheeded = router_->unheeded();
    router_->Obey({.there = true}, input_.time);
    EXPECT_FALSE(router_->unheeded());
    return unheeded;
  }
  static std::optional<std::uint16_t> RemoteKeysOf(const char* keys) {
    return MakeChord({.keys = keys, .does = "damp"}, "").keys;
  }

  using Pair = std::pair<double, double>;
  robot::RobotSpec spec_;
  MotionConfig config_;
  MotionInput input_;
  std::vector<MotionGoal> asked_;
  bool walks_ = true;
  std::unique_ptr<CommandRouter> router_;
};

TEST_F(CommandRouterTest, FollowsTheServiceAndRefusesLowCmd) {
  Make();
  EXPECT_EQ(Offer(), robot::Refusal::kMotionService);
  EXPECT_EQ(Torques(), Pair(kService, kService));
  EXPECT_EQ(router_->gate().state(), GateState::kClosed);
}

TEST_F(CommandRouterTest, HoldsTheStartCommandWithoutAService) {
  config_.service = kNoService;
  Make();
  EXPECT_EQ(Torques(), Pair(kStartTorque, kStartTorque));
  EXPECT_EQ(Offer(), robot::Refusal::kNone);
  EXPECT_EQ(Torques(), Pair(kLowCmd, kLowCmd));
}

TEST_F(CommandRouterTest, BrakesAfterReleaseUntilLowCmdComes) {
  Make();
  Torques();
  router_->owner().Release();
  Torques();
  EXPECT_EQ(router_->gate().state(), GateState::kDamping);
  EXPECT_EQ(router_->gate().timeouts(), 0U);
  EXPECT_EQ(Offer(), robot::Refusal::kNone);
  EXPECT_EQ(Torques(), Pair(kLowCmd, kLowCmd));
}

TEST_F(CommandRouterTest, GivesTheMotorsBackToASelectedService) {
  Make();
  router_->owner().Release();
  Offer();
  EXPECT_EQ(Torques(), Pair(kLowCmd, kLowCmd));
  router_->owner().Select("ai");
  EXPECT_EQ(Offer(), robot::Refusal::kMotionService);
  EXPECT_EQ(Torques(), Pair(kService, kService));
}

TEST_F(CommandRouterTest, LetsWhoeverSpokeLastHaveTheMotorsInAFight) {
  config_.fight = true;
  Make();
  EXPECT_EQ(Torques(), Pair(kService, kService));
  EXPECT_EQ(Offer(), robot::Refusal::kNone);
  EXPECT_EQ(Torques(false), Pair(kLowCmd, kLowCmd));
  EXPECT_EQ(Torques(false), Pair(kLowCmd, kLowCmd));
  EXPECT_EQ(Torques(), Pair(kService, kService));
}

TEST_F(CommandRouterTest, MixesTheArmsOverTheServiceOnly) {
  Make();
  EXPECT_EQ(OfferArms(Of(kArms), 0.5), robot::Refusal::kNone);
  EXPECT_EQ(Torques(), Pair(kService, 5));
  router_->owner().Release();
  Offer();
  EXPECT_EQ(Torques(), Pair(kLowCmd, kLowCmd));
  EXPECT_EQ(OfferArms(Of(kArms), 1), robot::Refusal::kNoMotionService);
  router_->owner().Select("ai");
  EXPECT_EQ(Torques(), Pair(kService, kService));  // what came before the service is forgotten
}

TEST_F(CommandRouterTest, LeavesTheMotorsToTheUserWhenTheServiceDoes) {
  Make();
  EXPECT_EQ(OfferUser(), robot::Refusal::kNotHandedOver);
  EXPECT_EQ(Torques(), Pair(kService, kService));
  router_->owner().onboard().user_control = true;
  EXPECT_EQ(Torques(), Pair(kService, kService));
  EXPECT_EQ(OfferUser(), robot::Refusal::kNone);
  EXPECT_EQ(Torques(), Pair(kUser, kUser));
  EXPECT_EQ(Offer(), robot::Refusal::kMotionService);
  router_->owner().onboard().user_control = false;
  EXPECT_EQ(Torques(), Pair(kService, kService));
}

TEST_F(CommandRouterTest, CountsWhatTheArmsAndTheUserAreRefused) {
  Make();
  EXPECT_EQ(OfferArms(Of(kArms), 0.5), robot::Refusal::kNone);
  EXPECT_EQ(OfferArms(Of(kArms), std::nan("")), robot::Refusal::kNotFinite);
  robot::RobotCommand harmful = Of(kArms);
  harmful.motors[0].kp = -1;
  EXPECT_EQ(OfferArms(harmful, 1), robot::Refusal::kGain);
  EXPECT_EQ(Torques(), Pair(kService, 5));
  router_->owner().Release();
  EXPECT_EQ(OfferUser(), robot::Refusal::kNoMotionService);
  EXPECT_EQ(router_->counts(robot::kArmSdkTopic).accepted, 1U);
  EXPECT_EQ(Refused(robot::kArmSdkTopic, robot::Refusal::kNotFinite), 1U);
  EXPECT_EQ(Refused(robot::kArmSdkTopic, robot::Refusal::kGain), 1U);
  EXPECT_EQ(Refused(robot::kUserLowCmdTopic, robot::Refusal::kNoMotionService), 1U);
}

TEST_F(CommandRouterTest, CountsEveryTopicApart) {
  spec_.hands = {{.name = "left", .motors = {{.joint = "thumb"}}},
                 {.name = "right", .motors = {{.joint = "thumb"}, {.joint = "index"}}}};
  Make();
  router_->owner().Release();
  const std::size_t right = robot::kFirstHandTopic + 1;
  EXPECT_EQ(OfferTo(right, Of(1)), robot::Refusal::kNone);
  EXPECT_EQ(OfferTo(right, Of(1), robot::Refusal::kMotorMode), robot::Refusal::kMotorMode);
  EXPECT_EQ(OfferTo(robot::kFirstHandTopic, Of(1)), robot::Refusal::kMotorCount);
  EXPECT_EQ(Offer(), robot::Refusal::kNone);
  EXPECT_EQ(router_->Current(input_, false, 0.002).motors[4].tau, 1);
  EXPECT_EQ(router_->counts(right).accepted, 1U);
  EXPECT_EQ(Refused(right, robot::Refusal::kMotorMode), 1U);
  EXPECT_EQ(Refused(robot::kFirstHandTopic, robot::Refusal::kMotorCount), 1U);
  EXPECT_EQ(Refused(robot::kLowCmdTopic, robot::Refusal::kMotorMode), 0U);
  router_->Current(input_, false, 0.002);
  input_.time += 1;
  router_->Current(input_, false, 0.002);
  EXPECT_EQ(router_->counts(robot::kLowCmdTopic).timeouts, 1U);
  EXPECT_EQ(router_->counts(right).timeouts, 0U);
}

// A gripper that follows half of what comes by rt/hand_sdk.
class HandSdkTest : public CommandRouterTest {
 protected:
  HandSdkTest() {
    spec_.hands = {{.name = "left", .law = "dex1", .motors = {{.joint = "jaw"}}, .sdk_slot = 0}};
    Make();
    Torques();
  }
  robot::Refusal OfferSdk() {
    return OfferTo(robot::kHandSdkTopic,
                   {.motors = {{.enabled = true, .tau = kUser}}, .weight = 0.5});
  }
  double Jaw() {
    Torques();
    return router_->command().motors[2].tau;
  }
};

TEST_F(HandSdkTest, IsMixedByItsWeightWithTheHandsOwnTopic) {
  EXPECT_EQ(OfferSdk(), robot::Refusal::kNone);
  EXPECT_EQ(Jaw(), kUser / 2);
  EXPECT_EQ(OfferTo(robot::kFirstHandTopic, {.motors = {{.enabled = true, .tau = 1}}}),
            robot::Refusal::kNone);
  EXPECT_EQ(Jaw(), (kUser + 1) / 2);
  EXPECT_EQ(router_->hand_weight(input_.time), 0.5);
  EXPECT_EQ(Torques(), Pair(kService, kService)) << "the body does not follow it";
}

TEST_F(HandSdkTest, FallsBackWhenItsProgramGoesSilent) {
  OfferSdk();
  input_.time += spec_.hand_sdk_timeout;
  EXPECT_EQ(Jaw(), 0);
}

TEST_F(HandSdkTest, IsRefusedWhileTheServiceDampsAndForgottenUntilItIsSentAnew) {
  OfferSdk();
  router_->owner().Ask(goal::Damp{});
  EXPECT_EQ(Jaw(), 0);
  EXPECT_EQ(OfferSdk(), robot::Refusal::kDamping);
  router_->owner().Restart();
  EXPECT_EQ(Jaw(), 0);
  EXPECT_EQ(OfferSdk(), robot::Refusal::kNone);
  EXPECT_EQ(Jaw(), kUser / 2);
  EXPECT_EQ(router_->counts(robot::kHandSdkTopic).accepted, 2U);
  EXPECT_EQ(Refused(robot::kHandSdkTopic, robot::Refusal::kDamping), 1U);
}

TEST_F(HandSdkTest, NeedsAMotionService) {
  OfferSdk();
  router_->owner().Release();
  EXPECT_EQ(Jaw(), 0);
  EXPECT_EQ(OfferSdk(), robot::Refusal::kNoMotionService);
}

TEST_F(CommandRouterTest, PassesChordsToTheService) {
  Make();
  Press("L2+Y");  // not from state 0
  EXPECT_TRUE(asked_.empty());
  Press("L2+B");
  ASSERT_EQ(asked_.size(), 1U);
  EXPECT_EQ(asked_[0], MotionGoal(goal::Damp{}));
  Press("L2+Y");
  EXPECT_EQ(asked_.back(), MotionGoal(goal::ZeroTorque{}));
}

TEST_F(CommandRouterTest, DebugReleasesAndNoChordLeavesIt) {
  Make();
  Press("L2+R2");
  EXPECT_EQ(router_->owner().active(), "");
  EXPECT_EQ(router_->gate().state(), GateState::kDamping);
  Press("L2+Y");
  EXPECT_EQ(router_->gate().state(), GateState::kLimp);
  Press("L2+B");
  EXPECT_EQ(router_->gate().state(), GateState::kDamping);
  for (const char* keys : {"L2+R2", "L2+UP", "START"}) Press(keys);
  EXPECT_EQ(router_->owner().active(), "");
}

TEST_F(CommandRouterTest, ChordsDoNothingToAReleasedRobotWithoutDebug) {
  spec_.remote.chords.erase(spec_.remote.chords.begin());
  Make();
  router_->owner().Release();
  Torques();
  Press("L2+Y");
  EXPECT_EQ(router_->gate().state(), GateState::kDamping);
}

TEST_F(CommandRouterTest, SticksMoveAndTheirEndStops) {
  Make();
  router_->Obey({.there = true, .lx = 0.5, .ly = 1, .rx = -1}, 0);
  ASSERT_EQ(asked_.size(), 1U);
  EXPECT_EQ(asked_[0], MotionGoal(goal::Move{1, -0.25, 2, 0.1, true}));
  router_->Obey({.there = true}, 0);
  ASSERT_EQ(asked_.size(), 2U);
  EXPECT_EQ(asked_[1], MotionGoal(goal::Move{0, 0, 0, 0.1, true}));
  router_->Obey({.there = true}, 0);
  EXPECT_EQ(asked_.size(), 2U);
}

TEST_F(CommandRouterTest, SticksAvoidObstaclesWhileTheSwitchIsOn) {
  Make();
  router_->owner().onboard().avoids = true;
  router_->Obey({.there = true, .ly = 1}, 0);
  router_->owner().onboard().avoids = false;
  router_->Obey({.there = true, .ly = 1}, 0);
  ASSERT_EQ(asked_.size(), 2U);
  EXPECT_TRUE(std::get<goal::Move>(asked_[0]).avoids);
  EXPECT_FALSE(std::get<goal::Move>(asked_[1]).avoids);
}

TEST_F(CommandRouterTest, SticksWithinTheirRestMoveNothing) {
  Make();
  router_->Obey({.there = true, .lx = 0.009, .ly = -0.009, .rx = 0.009}, 0);
  EXPECT_TRUE(asked_.empty());
  router_->Obey({.there = true, .lx = 0.009, .ly = 0.02}, 0);
  ASSERT_EQ(asked_.size(), 1U);
  EXPECT_EQ(asked_[0], MotionGoal(goal::Move{0.02, 0, 0, 0.1, true}));
}

TEST_F(CommandRouterTest, SticksThatAreSwitchedOffStopWhatTheyBeganAndMoveNothing) {
  Make();
  router_->Obey({.there = true, .ly = 1}, 0);
  router_->owner().onboard().sticks = false;
  router_->Obey({.there = true, .ly = 1}, 0);
  ASSERT_EQ(asked_.size(), 2U);
  EXPECT_EQ(asked_[1], MotionGoal(goal::Move{0, 0, 0, 0.1, true}));
  router_->Obey({.there = true, .ly = 1}, 0);
  EXPECT_EQ(asked_.size(), 2U);
  EXPECT_EQ(router_->stick_wish(), (std::array<double, 3>{}));
  router_->owner().Restart();
  router_->Obey({.there = true, .ly = 1}, 0);
  EXPECT_EQ(asked_.size(), 3U);
}

TEST_F(CommandRouterTest, TellsWhatOfTheRemoteControllerTheServiceDoesNotDo) {
  using Reason = Unheeded::Reason;
  spec_.remote.chords.push_back({.keys = "R2+A", .does = "set_fsm", .value = 801});
  spec_.remote.chords.push_back({.keys = "L2+X", .does = "sit"});
  Make();
  EXPECT_EQ(UnheededOf("L2+Y")->reason, Reason::kState);  // from state 1 alone
  EXPECT_FALSE(UnheededOf("L2+B"));
  EXPECT_FALSE(UnheededOf("L2+Y"));
  EXPECT_EQ(UnheededOf("L2+X")->reason, Reason::kState);
  const std::optional<Unheeded> run = UnheededOf("R2+A");
  ASSERT_TRUE(run);
  EXPECT_EQ(run->reason, Reason::kNotSimulated);
  EXPECT_EQ(run->keys, *RemoteKeysOf("R2+A"));
  EXPECT_EQ(run->wish, 801);
  EXPECT_FALSE(UnheededOf("R1+R2"));  // no chord
}

TEST_F(CommandRouterTest, TellsOnceOfSticksThatMoveNothing) {
  walks_ = false;
  Make();
  const auto push = [&](double ly) {
    router_->Obey({.there = true, .ly = ly}, input_.time);
    return router_->unheeded();
  };
  ASSERT_TRUE(push(0.5));
  EXPECT_FALSE(push(0.6));
  EXPECT_FALSE(push(0));
  const std::optional<Unheeded> again = push(1);
  ASSERT_TRUE(again);
  EXPECT_EQ(again->reason, Unheeded::Reason::kNotSimulated);
  EXPECT_EQ(again->keys, 0);
}

TEST_F(CommandRouterTest, TellsOfAChordThatNoServiceHearsUnlessAProgramMoves) {
  spec_.remote.chords.push_back({.keys = "L2+A", .does = "stand_up"});
  config_.service = kNoService;
  Make();
  EXPECT_EQ(UnheededOf("L2+A")->reason, Unheeded::Reason::kNoMotionService);
  EXPECT_FALSE(UnheededOf("L2+B"));   // damps without a service, too
  EXPECT_FALSE(UnheededOf("L2+R2"));  // released it is
  Offer();
  Torques();
  EXPECT_FALSE(UnheededOf("L2+A"));  // may be a key of that program
}

}  // namespace
}  // namespace understudy::authority
