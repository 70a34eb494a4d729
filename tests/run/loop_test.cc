// The loop by a clock that is turned by hand: no network, no socket, no thread.
#include "run/loop.h"

#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <gmock/gmock.h>

#include "assembly/make_world.h"
#include "emulator/told_event.h"
#include "run/attachments.h"
#include "tests/support/fake_port.h"
#include "tests/support/fake_services.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/manual_clock.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/requests.h"

namespace understudy::run {
namespace {

using namespace std::chrono_literals;  // NOLINT(google-build-using-namespace): 1ms reads best
using emulator::EventKind;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

// Calls a function after each cycle, and another before it.
class Probe final : public Attachment {
 public:
  using Look = std::function<std::optional<ExitCode>(const Cycle&)>;

  explicit Probe(
      Look after, std::function<bool()> allows = [] { return true; })
      : after_(std::move(after)), allows_(std::move(allows)) {}

  bool AllowsStep() const override { return allows_(); }
  std::optional<ExitCode> After(const Cycle& cycle) override { return after_(cycle); }

 private:
  Look after_;
  std::function<bool()> allows_;
};

// The fixture robot in steps of 1 ms.
class LoopTest : public test::MujocoTest {
 protected:
  void Start() {
    world_ = assembly::MakeWorld(
        test::FixtureWorld(config_.robots[0].spec, config_.physics.timestep), config_,
        [this](std::size_t) {
          return emulator::Ports{&port_, &services_};
        },
        &inbox_);
  }
  // Runs until an attachment ends it or `duration` [simulated s] is over.
  ExitCode Run(std::vector<Attachment*> attachments, double duration) {
    if (!world_) Start();
    StopRule stop(duration, config_.physics.timestep, nullptr);
    attachments.push_back(&stop);
    return Loop(&clock_, world_.get(), std::move(attachments)).Run();
  }
  std::vector<emulator::Event> Events(EventKind kind) const {
    std::vector<emulator::Event> found;
    emulator::EventRing::Reader reader(&world_->events());
    for (emulator::Event event; reader.Next(&event);) {
      if (event.kind == kind) found.push_back(event);
    }
    return found;
  }
  emulator::World& world() { return *world_; }

  config::Config config_ = test::FixtureConfig();
  test::FakePort port_;
  test::FakeServices services_;
  test::ManualClock clock_;
  emulator::Inbox inbox_;
  std::unique_ptr<emulator::World> world_;
};

TEST_F(LoopTest, TimeEndsAtTheDurationExactly) {
  for (const auto& [duration, steps] :
       std::vector<std::pair<double, int>>{{0.001, 1}, {0.502, 502}, {0.5021, 503}, {1.1, 1100}}) {
    world_.reset();
    EXPECT_EQ(Run({}, duration), ExitCode::kOk);
    EXPECT_EQ(world().step(), steps) << duration;
  }
}

TEST_F(LoopTest, ARunEndsInTheStepInWhichItShould) {
  Start();
  StopRule stop(0, 0.001, [](std::int64_t step, emulator::EventRing*) { return step == 7; });
  EXPECT_EQ(Loop(&clock_, world_.get(), {&stop}).Run(), ExitCode::kOk);
  EXPECT_EQ(world().step(), 7);
}

TEST_F(LoopTest, StepsKeepToTheWallClockAtTheSpeedThatIsAsked) {
  config_.time.speed = 2;
  Run({}, 0.102);
  EXPECT_EQ(clock_.Now(), 50ms);  // from the second step, which follows the first at once
}

TEST_F(LoopTest, EachAttachmentLooksAfterEachTickInItsOrder) {
  std::string looks;
  Probe first([&](const Cycle& cycle) {
    EXPECT_TRUE(cycle.ticked);
    looks += "a" + std::to_string(cycle.world.step());
    return std::nullopt;
  });
  Probe second([&](const Cycle& cycle) {
    looks += "b" + std::to_string(cycle.world.step());
    return std::nullopt;
  });
  Run({&first, &second}, 0.003);
  EXPECT_EQ(looks, "a1b1a2b2a3b3");
}

TEST_F(LoopTest, TheFirstThatEndsTheRunHasTheLastWord) {
  int looks = 0;
  Probe ends([](const Cycle&) { return ExitCode::kNeighbour; });
  Probe later([&](const Cycle&) {
    ++looks;
    return ExitCode::kDiverged;
  });
  EXPECT_EQ(Run({&ends, &later}, 1), ExitCode::kNeighbour);
  EXPECT_EQ(looks, 0);
}

TEST_F(LoopTest, APausedWorldAttends) {
  Start();
  std::vector<std::future<emulator::Answer>> answers;
  int ticks = 0, rounds = 0;
  Probe asks([&](const Cycle& cycle) -> std::optional<ExitCode> {
    ticks += cycle.ticked;
    if (cycle.ticked && ticks == 3) inbox_.Put(test::RequestOf("pause"));
    if (cycle.ticked) return {};
    if (++rounds == 10) {
      answers.push_back(std::move(inbox_.Put(test::RequestOf("clamp", true))->answer));
    }
    return rounds == 12 ? std::optional(ExitCode::kOk) : std::nullopt;
  });
  Run({&asks}, 1);
  EXPECT_EQ(ticks, 4);  // the pause is taken by the tick after it was asked
  EXPECT_EQ(world().step(), 4);
  ASSERT_THAT(answers, SizeIs(1));
  EXPECT_TRUE(answers[0].get());
  EXPECT_GT(port_.rests(), 0);
}

TEST_F(LoopTest, ASlowWorldAttendsBetweenItsSteps) {
  config_.time.speed = 0.1;  // a step each 10 ms
  int attended = 0;
  Probe counts([&](const Cycle& cycle) {
    attended += !cycle.ticked;
    return std::nullopt;
  });
  Run({&counts}, 0.004);
  EXPECT_GE(attended, 8);
  EXPECT_EQ(clock_.Now(), 20ms);
}

TEST_F(LoopTest, NoStepIsMadeWhileAnAttachmentDoesNotAllowItAndNoneIsLateAfterwards) {
  bool allows = true;
  int held = 0;
  Probe holds(
      [&](const Cycle& cycle) {
        if (cycle.ticked && cycle.world.step() == 5) allows = false;
        if (!cycle.ticked && ++held == 100) allows = true;
        return std::nullopt;
      },
      [&] { return allows; });
  Run({&holds}, 0.01);
  EXPECT_EQ(held, 100);
  EXPECT_EQ(world().step(), 10);
  EXPECT_THAT(Events(EventKind::kOverrun), IsEmpty());
  EXPECT_THAT(Events(EventKind::kStall), IsEmpty());
}

TEST_F(LoopTest, ALateTickIsAnOverrunAndALongStallMovesTheDeadlines) {
  Probe works([&](const Cycle& cycle) {
    if (cycle.world.step() == 5) clock_.Advance(5ms);
    if (cycle.world.step() == 20) clock_.Advance(3s);
    return std::nullopt;
  });
  Run({&works}, 0.03);
  const auto overruns = Events(EventKind::kOverrun);
  ASSERT_FALSE(overruns.empty());
  EXPECT_EQ(overruns[0].step, 5);
  EXPECT_NEAR(overruns[0].numbers[0], 0.004, 1e-9);
  const auto stalls = Events(EventKind::kStall);
  ASSERT_THAT(stalls, SizeIs(1));
  EXPECT_EQ(stalls[0].step, 20);
  EXPECT_NEAR(stalls[0].numbers[0], 2.999, 1e-9);
}

TEST_F(LoopTest, WhatAttachmentsDoAfterTheFirstStepMakesNoneLate) {
  int calls = 0;
  FirstStep starts([&] {
    ++calls;
    clock_.Advance(1s);
  });
  Run({&starts}, 0.01);
  EXPECT_EQ(calls, 1);
  EXPECT_THAT(Events(EventKind::kOverrun), IsEmpty());
  EXPECT_THAT(Events(EventKind::kStall), IsEmpty());
}

TEST_F(LoopTest, AnUnforeseenDivergenceEndsTheRunInItsStep) {
  for (robot::MotorSpec& motor : config_.robots[0].spec.motors) {
    motor.torque_limit = 1e30;
    motor.type = "";
  }
  config_.robots[0].spec.battery.internal_ohm = 0;
  config_.robots[0].start.pose = "standing";
  Probe tears([&](const Cycle& cycle) {
    if (cycle.world.step() != 20) return std::optional<ExitCode>();
    port_.Send({.motors = std::vector<robot::MotorCommand>(6, {.enabled = true, .tau = 1e30})});
    return std::optional<ExitCode>();
  });
  DivergenceStop divergence;
  EXPECT_EQ(Run({&tears, &divergence}, 1), ExitCode::kDiverged);
  EXPECT_EQ(world().step(), 21);
  EXPECT_NE(mjcf::TakeMujocoWarning(), "");
}

TEST_F(LoopTest, StatusIsPostedAfterTheFirstStepAndWhereverAClientMayWaitForIt) {
  Start();
  emulator::StatusBoard board;
  StatusPoster status(0, &board, nullptr);
  std::vector<std::int64_t> posted;
  EXPECT_FALSE(board.Read().loop.ready);
  Probe reads([&](const Cycle& cycle) -> std::optional<ExitCode> {
    if (cycle.world.step() == 24) inbox_.Put(test::RequestOf("pause"));
    const std::int64_t steps = board.Read().steps;
    if (posted.empty() || posted.back() != steps) posted.push_back(steps);
    return cycle.ticked ? std::nullopt : std::optional(ExitCode::kOk);
  });
  Run({&status, &reads}, 1);
  EXPECT_THAT(posted, ElementsAre(1, 10, 20, 25));
  EXPECT_TRUE(board.Read().loop.ready);
  EXPECT_TRUE(board.Read().paused);
}

TEST_F(LoopTest, ASnapshotIsFilledInAfterTheCycleInWhichItIsAsked) {
  Start();
  Snapshots snapshots(world(), 0);
  emulator::SnapshotMailbox::Observer* const observer = snapshots.mailbox()->Join();
  std::vector<std::int64_t> steps;
  Probe asks([&](const Cycle& cycle) {
    if (cycle.world.step() == 4) observer->Ask(emulator::kPartPositions);
    steps.push_back(snapshots.mailbox()->Newest()->step);
    return std::nullopt;
  });
  Run({&snapshots, &asks}, 0.006);
  EXPECT_THAT(steps, ElementsAre(0, 0, 0, 0, 5, 5));
}

// Programs that take three attempts to reach each instant.
class SlowPrograms final : public time::ProgramClock {
 public:
  std::string Begin() override { return ""; }
  bool Reach(time::Clock::Time simulated, time::Clock::Time) override {
    reached.push_back(simulated);
    return reached.size() % 3 == 0;
  }
  void HoldMessages(bool hold) override { held += hold ? '(' : ')'; }
  void ProgramStarts() override {}
  void ProgramEnded() override {}
  void End() override {}
  void Stand() override { ++stood; }

  std::vector<time::Clock::Time> reached{};
  int stood = 0;
  std::string held{};
};

TEST_F(LoopTest, NoStepIsMadeBeforeProgramsHaveReachedItsInstant) {
  Start();
  SlowPrograms programs;
  std::string cycles;
  Probe probe([&cycles](const Cycle& cycle) {
    cycles += cycle.ticked ? 't' : '-';
    return std::nullopt;
  });
  StopRule stop(0.002, 0.001, nullptr);
  Loop(&clock_, world_.get(), {&probe, &stop}, &programs).Run();
  EXPECT_EQ(cycles, "--t--t");
  EXPECT_THAT(programs.reached, ElementsAre(0ms, 0ms, 0ms, 1ms, 1ms, 1ms));
}

TEST_F(LoopTest, ProgramsHearWhatAStepSaysWhenItIsOver) {
  Start();
  SlowPrograms programs;
  services_.Call([&programs](authority::MotorOwner*) { EXPECT_EQ(programs.held, "("); });
  StopRule stop(0.002, 0.001, nullptr);
  Loop(&clock_, world_.get(), {&stop}, &programs).Run();
  EXPECT_EQ(programs.held, "()()");
}

TEST_F(LoopTest, CallsOfProgramsOnTheirOwnClockWaitForTheStep) {
  Start();
  SlowPrograms programs;
  std::string cycles;
  services_.Call([&cycles](authority::MotorOwner*) { cycles += 'c'; });
  Probe probe([&cycles](const Cycle& cycle) {
    cycles += cycle.ticked ? 't' : '-';
    return std::nullopt;
  });
  StopRule stop(0.001, 0.001, nullptr);
  Loop(&clock_, world_.get(), {&probe, &stop}, &programs).Run();
  EXPECT_EQ(cycles, "--ct");
}

TEST_F(LoopTest, ServicesWaitForProgramsByTheClockOfThese) {
  Start();
  clock_.Advance(1h);
  SlowPrograms programs;
  StopRule stop(0.003, 0.001, nullptr);
  Loop(&clock_, world_.get(), {&stop}, &programs).Run();
  EXPECT_EQ(services_.polled_at(), 2ms);
}

TEST_F(LoopTest, PauseStopsTheTimeOfPrograms) {
  Start();
  SlowPrograms programs;
  int cycles = 0;
  std::size_t reached = 0;
  Probe probe([&](const Cycle& cycle) -> std::optional<ExitCode> {
    if (++cycles == 3) inbox_.Put(test::RequestOf("pause"));
    if (!cycle.world.pace().paused) return std::nullopt;
    if (reached == 0) reached = programs.reached.size();
    return cycles < 20 ? std::nullopt : std::optional(ExitCode::kOk);
  });
  Loop(&clock_, world_.get(), {&probe}, &programs).Run();
  EXPECT_EQ(programs.reached.size(), reached);
  EXPECT_EQ(programs.stood, 20 - 4);  // since the cycle that took the request
}

}  // namespace
}  // namespace understudy::run
