#include "signals/condition_watch.h"

#include <cmath>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "config/load.h"
#include "physics/world_model.h"
#include "schema/yaml_document.h"
#include "script/script.h"
#include "tests/emulator/emulator_test.h"
#include "tests/emulator/state_bytes.h"

namespace understudy::signals {
namespace {

using emulator::EventKind;

class ConditionWatchTest : public emulator::EmulatorTest {
 protected:
  void Play(const std::string& events) { PlayIn(world_.get(), events); }
  void PlayIn(emulator::World* world, const std::string& events) const {
    script::Play(
        script::ReadEvents(schema::ParseYaml(events, "s"), RunningNames(config_.robots[0].spec)),
        world);
  }
  // The step in which each event that was waited for came.
  std::vector<std::int64_t> Came(const emulator::World& world) const {
    std::vector<std::int64_t> steps;
    emulator::EventRing::Reader reader(&world.events());
    for (emulator::Event event; reader.Next(&event);) {
      if (event.kind == EventKind::kScriptWait && event.numbers[2] != 0) {
        steps.push_back(event.step);
      }
    }
    return steps;
  }
  // When a condition is met that is waited for from the start; -1 if it is not, in some steps.
  std::int64_t When(const std::string& condition, int steps = 50) {
    Play("[{when: '" + condition + "', clamp: on}]");
    Tick(steps);
    const auto came = Came(*world_);
    return came.empty() ? -1 : came.front();
  }
};

TEST_F(ConditionWatchTest, SeesACommandInTheTickAfterTheOneThatTookIt) {
  StartAs("standing");
  Play("[{when: lowcmd arrives, clamp: on}]");
  Tick(5);
  port_.Send(Torque(0));
  Tick(1);
  EXPECT_FALSE(world_->status(0).clamped);
  Tick(1);
  EXPECT_EQ(Came(*world_), (std::vector<std::int64_t>{6}));
  EXPECT_TRUE(world_->status(0).clamped);
}

TEST_F(ConditionWatchTest, SeesARefusedCommandArriveToo) {
  StartAs("standing");
  port_.Send(Torque(0), robot::Refusal::kCrc);
  EXPECT_EQ(When("lowcmd arrives"), 1);
}

TEST_F(ConditionWatchTest, KnowsHowLongTheCommandsHaveBeenAway) {
  StartAs("standing");
  Play("[{when: gap(lowcmd) > 9.5 ms, clamp: on}]");
  Tick(30);
  EXPECT_TRUE(Came(*world_).empty());  // none has come yet
  port_.Send(Torque(0));
  Tick(20);
  EXPECT_EQ(Came(*world_), (std::vector<std::int64_t>{41}));  // seen at 31
}

TEST_F(ConditionWatchTest, KnowsHowOftenCommandsComeOnceASecondHasPassed) {
  StartAs("standing");
  Play("[{when: rate(lowcmd) >= 100, clamp: on}, {when: rate(lowcmd) < 99, clamp: on}]");
  const int ticks = static_cast<int>(std::lround(1 / config_.physics.timestep));
  const int every = ticks / 100;
  for (int i = 0; i < ticks; ++i) {
    if (i % every == 0) port_.Send(Torque(0));
    Tick(1);
  }
  EXPECT_TRUE(Came(*world_).empty());  // unknown so far
  for (int i = 0; i < ticks; ++i) Tick(1);
  // The first one is seen at 1, and a second later the last hundred without it and one more; none
  // comes any more.
  ASSERT_EQ(Came(*world_).size(), 1U);
  EXPECT_EQ(Came(*world_)[0], ticks + 1 + every);
}

TEST_F(ConditionWatchTest, KnowsWhatAPadFeels) {
  config_.robots[0].spec = test::FixtureRobotWithHand();
  config_.robots[0].spec.hands[0].pads = {{.site = ""}, {.site = "belly"}};  // under the trunk
  config_.robots[0].spec.hands[0].touch.spread = 0.05;
  StartAs("hanging");
  EXPECT_EQ(When("touch(belly) > 0"), -1);
  StartAs("lying");
  EXPECT_GE(When("touch(belly) > 1", 500), 0);
}

TEST_F(ConditionWatchTest, KnowsHowFarTheFirstTakenAnglesAreFromTheJoints) {
  StartAs("standing");
  Play("[{when: first_jump between 0.2999 and 0.3001, clamp: on}]");
  Tick(5);
  robot::RobotCommand command = Torque(0);
  port_.Send(command);  // asks for no angle
  Tick(2);
  for (std::size_t i = 0; i < command.motors.size(); ++i) {
    command.motors[i] = {.enabled = true, .q = world_->robot(0).sampled().motors[i].q, .kp = 1};
  }
  command.motors[1].q += 2;
  port_.Send(command, robot::Refusal::kCrc);  // is not taken
  Tick(2);
  command.motors[1].q = world_->robot(0).sampled().motors[1].q - 0.3;
  port_.Send(command);
  Tick(2);
  ASSERT_EQ(Came(*world_).size(), 1U);
  EXPECT_EQ(Came(*world_)[0], 10);
}

TEST_F(ConditionWatchTest, KnowsTorquesByTheirLimitsAndTemperatures) {
  const std::string joint = config_.robots[0].spec.motors[0].joint;
  StartAs("standing");
  EXPECT_GE(When("torque_share(" + joint + ") between 0 and 1 and tau_est_share(" + joint +
                 ") between 0 and 1 and temperature(" + joint + ") between 1 and 60"),
            0);
}

TEST_F(ConditionWatchTest, KnowsTheTruthOfTheInstant) {
  StartAs("hanging");
  Ask("crane.release");
  Tick(1);
  const double height = Height();
  Play("[{when: base.height < " + std::to_string(height - 0.05) + ", clamp: on}]");
  Tick(300);
  ASSERT_EQ(Came(*world_).size(), 1U);
  // Half of g times t squared is 5 cm at 0.101 s.
  EXPECT_NEAR(static_cast<double>(Came(*world_)[0]) * config_.physics.timestep, 0.101, 0.01);
}

TEST_F(ConditionWatchTest, KnowsTheCraneTheFeetAndTheJoints) {
  StartAs("hanging");
  EXPECT_GE(When("crane.tension > 1"), 0);
  StartAs("standing");
  EXPECT_GE(When("feet.force > 1"), 0);
  StartAs("hanging");
  EXPECT_EQ(When("feet.force > 1"), -1);
  StartAs("standing");
  const std::string joint = config_.robots[0].spec.motors[0].joint;
  EXPECT_GE(When("q(" + joint + ") between -7 and 7 and torque(" + joint + ") > -1000"), 0);
  StartAs("standing");
  EXPECT_EQ(When("q(" + joint + ") > 7"), -1);
}

TEST_F(ConditionWatchTest, KnowsWhatPressesOnAHand) {
  config_.robots[0].spec = test::FixtureRobotWithHand();
  config_.robots[0].spec.hands[0].pads = {{.site = "imu"}};  // on the trunk
  StartAs("hanging");
  EXPECT_GE(When("hand_force(neck) <= 0"), 0);
  StartAs("hanging");
  EXPECT_EQ(When("hand_force(neck) > 0"), -1);
  StartAs("lying");
  EXPECT_GE(When("hand_force(neck) > 1", 500), 0);
}

TEST_F(ConditionWatchTest, KnowsHowFarTheNearestObstacleIs) {
  StartAs("standing");
  EXPECT_GE(When("nearest_obstacle > 9.9 m"), 0) << "there is none";
  StartAs("standing");
  EXPECT_EQ(When("nearest_obstacle < 9 m"), -1);
}

// The arm of the documentation, whose column stands on the ground.
class FixedBaseConditionWatchTest : public ConditionWatchTest {
 protected:
  void Start() {
    const std::filesystem::path source = UNDERSTUDY_SOURCE_DIR;
    config_ = config::LoadConfig({.robot = source / "examples/two_joint_arm/arm.yaml"}, source);
    const std::vector<physics::PlacedRobot> placed = {
        {config_.robots[0].spec, source / "models" / config_.robots[0].spec.model}};
    world_ = MakeIn({physics::LoadWorldModel(placed, test::FixtureFile("fixture_ground.xml"),
                                             config_.physics.timestep),
                     placed},
                    &port_, &inbox_);
  }
};

TEST_F(FixedBaseConditionWatchTest, RefusesConditionsOnABaseThatDoesNotMove) {
  Start();
  EXPECT_THAT([this] { Play("[{when: base.height > -1, clamp: on}]"); },
              testing::ThrowsMessage<ConfigError>(
                  testing::HasSubstr("s:1: when: base.height: the base of this robot is fixed")));
  EXPECT_THAT([this] { Play("[{when: feet.force < 1 and not base.speed > 1, clamp: on}]"); },
              testing::ThrowsMessage<ConfigError>(testing::HasSubstr("base.speed")));
}

TEST_F(FixedBaseConditionWatchTest, KnowsTheTorquesOfTheJoints) {
  Start();
  EXPECT_GE(When("torque(" + config_.robots[0].spec.motors[0].joint + ") between -1000 and 1000"),
            0);
}

TEST_F(ConditionWatchTest, FollowsWhatEventsSay) {
  config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
  StartAs("clamped");
  EXPECT_EQ(When("service is ai"), 0);
  StartAs("standing");
  EXPECT_EQ(When("gate is closed or service is mcf"), -1);
  StartAs("standing");
  Play(
      "[{when: crane happens, clamp: on}, {when: crane.attached is true, clamp: on}, {when: "
      "remote.keys is L2+B, clamp: on}, {when: count(remote) >= 2, clamp: on}]");
  Tick(3);
  EXPECT_TRUE(Came(*world_).empty());
  Ask("crane.attach");
  Tick(3);
  EXPECT_EQ(Came(*world_), (std::vector<std::int64_t>{4, 4}));
  Ask("remote.hold", "L2+B");
  Tick(3);
  EXPECT_EQ(Came(*world_).size(), 3U);
  Ask("remote.release", "B");
  Tick(3);
  EXPECT_EQ(Came(*world_).size(), 4U);
}

TEST_F(ConditionWatchTest, AnEventHappensOnceAndNotBeforeTheWait) {
  StartAs("standing");
  Play("[{at: 0.02, when: push happens, clamp: on}]");
  Tick(5);
  Ask("push", {{"force", {1, 0, 0}}});
  Tick(40);
  EXPECT_TRUE(Came(*world_).empty());
  Ask("push", {{"force", {1, 0, 0}}});
  Tick(2);
  EXPECT_EQ(Came(*world_).size(), 1U);
}

TEST_F(ConditionWatchTest, HearsWhatTheProgramPrints) {
  StartAs("standing");
  Play("[{when: the program prints \"one two\", clamp: on}]");
  Tick(2);
  world_->events().Add(EventKind::kProgramPrints, 0, {}, "one");
  Tick(2);
  EXPECT_TRUE(Came(*world_).empty());
  world_->events().Add(EventKind::kProgramPrints, 0, {}, "one two");
  Tick(2);
  EXPECT_EQ(Came(*world_).size(), 1U);
}

TEST_F(ConditionWatchTest, EqualRunsWaitEquallyLongBitForBit) {
  config_.robots[0].start.pose = "hanging";
  config_.robots[0].sensors = {.quantise = true, .noise = true, .seed = 3};
  config_.robots[0].spec.encoder_noise = {.q_steps = 2, .dq_steps = 3, .tau_steps = 4};
  const std::string joint = config_.robots[0].spec.motors[0].joint;
  const auto play = [&] {
    test::FakePort port;
    emulator::Inbox inbox;
    const auto world = Make(&port, &inbox);
    PlayIn(world.get(),
           "[{at: 0.1, crane.release: }, {after: previous, when: feet.force > 5, within: 5, push: "
           "{force: [10, 0, 0]}}, {after: previous, at: 0.05, when: dq(" +
               joint + ") > 0.1 or base.tilt > 3 deg,  within: 1, push: {force: [0, 10, 0]}}]");
    for (int step = 0; step < 1500; ++step) world->Tick({});
    std::vector<std::string> told;
    for (const std::int64_t step : Came(*world)) told.push_back(std::to_string(step));
    EXPECT_EQ(told.size(), 2U);
    for (const test::FakePort::Sample& sample : port.samples()) {
      told.push_back(emulator::Bytes(sample.state));
    }
    return told;
  };
  EXPECT_EQ(play(), play());
}

}  // namespace
}  // namespace understudy::signals
