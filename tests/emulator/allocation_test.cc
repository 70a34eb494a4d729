// That a tick allocates nothing, counted in this whole program: malloc and its relatives are
// replaced by counting ones. A sanitizer has its own malloc, so there only operator new counts.
#include <atomic>
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <new>

#include <mujoco/mujoco.h>

#include "config/load.h"
#include "schema/yaml_document.h"
#include "script/script.h"
#include "tests/emulator/emulator_test.h"

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define UNDERSTUDY_COUNTS_NEW_ONLY
#endif

namespace {

std::atomic<std::int64_t> allocations = 0;

}  // namespace

#ifdef UNDERSTUDY_COUNTS_NEW_ONLY

// Never inlined: seen from inside one of them, the compiler takes malloc and free for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}
// Of which std::stable_sort asks for its room.
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++allocations;
  return std::malloc(size);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

#else

// glibc's own, under its other names.
// NOLINTBEGIN(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)
extern "C" {
void* __libc_malloc(std::size_t size);
void* __libc_calloc(std::size_t count, std::size_t size);
void* __libc_realloc(void* memory, std::size_t size);
void* __libc_memalign(std::size_t alignment, std::size_t size);
// NOLINTEND(bugprone-reserved-identifier,cert-dcl37-c,cert-dcl51-cpp)

void* malloc(std::size_t size) {
  ++allocations;
  return __libc_malloc(size);
}
void* calloc(std::size_t count, std::size_t size) {
  ++allocations;
  return __libc_calloc(count, size);
}
void* realloc(void* memory, std::size_t size) {
  ++allocations;
  return __libc_realloc(memory, size);
}
void* aligned_alloc(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
void* memalign(std::size_t alignment, std::size_t size) {
  ++allocations;
  return __libc_memalign(alignment, size);
}
int posix_memalign(void** memory, std::size_t alignment, std::size_t size) {
  ++allocations;
  *memory = __libc_memalign(alignment, size);
  return *memory == nullptr ? ENOMEM : 0;
}
}

#endif

namespace understudy::emulator {
namespace {

class AllocationTest : public EmulatorTest {
 protected:
  std::int64_t CountIn(int ticks) {
    const std::int64_t before = allocations;
    for (int i = 0; i < ticks; ++i) EXPECT_EQ(world_->Tick({}), physics::StepHealth::kFine);
    return allocations - before;
  }
};

TEST_F(AllocationTest, IsSeenByTheCount) {
  const std::int64_t before = allocations;
  auto number = std::make_unique<int>(1);
  EXPECT_GE(allocations - before, 1);
#ifndef UNDERSTUDY_COUNTS_NEW_ONLY
  const std::int64_t between = allocations;
  mju_free(mju_malloc(100));  // MuJoCo's too
  EXPECT_GE(allocations - between, 1);
#endif
}

// It hangs, falls when its crane lets go, lands on its feet and is driven about there, with noise,
// with good commands and refused ones.
TEST_F(AllocationTest, DoesNotHappenInATick) {
  config_.robots[0].sensors = {};
  config_.robots[0].spec.encoder_noise = {.q_steps = 2, .dq_steps = 3, .tau_steps = 4};
  port_.TellEvery(1);
  port_.KeepTheLastOnly();
  StartAs("hanging");
  robot::RobotCommand command;
  for (int i = 0; i < 6; ++i) {
    command.motors.push_back({.enabled = true, .q = 0.1 * i, .kp = 100, .kd = 2});
  }
  port_.SendEveryTick(command);
  Ask("crane.release");
  CountIn(10);  // the first few may
  EXPECT_EQ(CountIn(2000), 0);
  EXPECT_LT(Height(), 0.5);

  command.motors[2].tau = NAN;
  port_.SendEveryTick(command);
  EXPECT_EQ(CountIn(1000), 0);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kDamping);
}

TEST_F(AllocationTest, DoesNotHappenWhereCommandsComeLate) {
  config_.robots[0].spec.dynamics.delay = 0.005;
  port_.KeepTheLastOnly();
  StartAs("standing");
  CountIn(10);
  port_.SendEveryTick(Torque(1));
  CountIn(1);  // the fake port's own copy
  EXPECT_EQ(CountIn(500), 0);
  Ask("reset");
  EXPECT_EQ(CountIn(50), 0);
}

TEST_F(AllocationTest, DoesNotHappenOnceWhatIsSlowIsAsLateAsItGets) {
  config_.robots[0].spec.buses = {
      {.name = "leg", .slots = {config_.robots[0].spec.motors[0].slot}}};
  config_.robots[0].spec.fans = {{.name = "front", .place = 2}};
  config_.robots[0].spec.dynamics.backlash = 0.01;
  config_.robots[0].spec.dynamics.ripple = 0.1;
  config_.robots[0].faults = {{.component = "rt/lowcmd", .fault = "delayed", .by = 0.02},
                              {.component = "bus.leg", .fault = "slow", .by = 0.01},
                              {.component = "bus.leg", .fault = "lost"},
                              {.component = "fan.front", .fault = "off"},
                              {.component = "imu", .fault = "off", .at = 0.1}};
  port_.KeepTheLastOnly();
  StartAs("clamped");
  port_.SendEveryTick(Torque(1));
  CountIn(60);
  EXPECT_EQ(CountIn(500), 0);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kFollowing);
}

TEST_F(AllocationTest, DoesNotHappenWhereSettingsChangeAndJointsAreMoved) {
  port_.KeepTheLastOnly();
  StartAs("clamped");
  CountIn(10);
  for (const char* key : {"sensors.noise_gain", "sensors.imu.gyro_misalignment",
                          "sensors.foot.cross_talk", "terrain.friction", "gate.timeout"}) {
    Ask("set", {{"key", key}, {"value", 0.5}});
    EXPECT_EQ(CountIn(2), 0) << key;
  }
  Ask("set", {{"key", "gate.mode"}, {"value", "lenient"}});
  Ask("joint", {{"joint", config_.robots[0].spec.motors[0].joint}, {"angle", 0.1}});
  EXPECT_EQ(CountIn(500), 0);
}

TEST_F(AllocationTest, DoesNotHappenOnTheCraneOrInTheClamp) {
  port_.KeepTheLastOnly();
  for (const char* pose : {"hanging", "clamped", "standing", "lying"}) {
    StartAs(pose);
    CountIn(10);
    EXPECT_EQ(CountIn(500), 0) << pose;
  }
}

// A motion service with arms mixed over it, a remote controller that is used, refused commands,
// a push, a drag, another speed and another pose.
TEST_F(AllocationTest, DoesNotHappenWhileAMotionServiceIsOn) {
  config_.robots[0].spec.services = {{.name = "ai_sport", .alias = "ai"}};
  config_.robots[0].spec.arm_sdk.slots = {6, 7};
  config_.robots[0].spec.remote.chords = {{.keys = "L2+B", .does = "damp"}};
  config_.robots[0].spec.remote.speed = {1, 1, 1};
  port_.KeepTheLastOnly();
  StartAs("hanging");
  port_.SendEveryTick(Torque(1));
  port_.SendArms(Torque(2), 0.5);
  world_->Play({{.at = 0.2, .request = test::RequestOf("remote.hold", "L2"), .where = ""},
                {.at = 0.3, .request = test::RequestOf("remote.press", "B"), .where = ""},
                {.at = 0.4,
                 .request = test::RequestOf("remote.sticks", {{"ly", 1}, {"for", 0.2}}),
                 .where = ""},
                {.at = 0.5,
                 .request = test::RequestOf("push", {{"force", {1, 0, 0}}, {"for", 0.1}}),
                 .where = ""},
                {.at = 0.5,
                 .request = test::RequestOf("drag", {{"body", "base"}, {"to", {0, 0, 2}}}),
                 .where = ""},
                {.at = 0.6, .request = test::RequestOf("speed", 2), .where = ""},
                {.at = 0.8, .request = test::RequestOf("reset", "standing"), .where = ""}});
  CountIn(10);
  EXPECT_EQ(CountIn(1000), 0);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kClosed);
  services_.Call([](authority::MotorOwner* owner) { owner->Release(); });
  EXPECT_EQ(CountIn(100), 0);
}

// For commands, the truth, samples and events, while events come and time-outs do not.
TEST_F(AllocationTest, DoesNotHappenWhileAScriptWaits) {
  port_.KeepTheLastOnly();
  StartAs("hanging");
  const std::string joint = config_.robots[0].spec.motors[0].joint;
  const std::string text =
      "[{at: 0.1, when: gap(lowcmd) > 1 or rate(lowcmd) < 1 or first_jump > 9 or q(" + joint +
      ") > 9 or base.tilt > 170 deg, clamp: on},"
      " {when: feet.force > 5 and remote.keys is not START+SELECT+UP+RIGHT, remote.hold: L2},"
      " {at: 0.1, when: lowcmd arrives, crane.release: },"
      " {after: previous, when: feet.force > 5, within: 5, push: {force: [1, 0, 0]}},"
      " {after: previous, at: 0.01, when: count(following) > 0, push: {force: [1, 0, 0]}}]";
  script::Play(script::ReadEvents(schema::ParseYaml(text, "s"),
                                  signals::RunningNames(config_.robots[0].spec)),
               world_.get());
  port_.SendEveryTick(Torque(0));
  Ask("remote.hold", "START+SELECT+UP+RIGHT+DOWN");
  CountIn(10);
  EXPECT_EQ(CountIn(4000), 0);
  const Status status = world_->status(0);
  EXPECT_EQ(status.script_done, 4U);
  EXPECT_EQ(status.script_waiting, 1U);
}

// With commands that come late to its motors, refused ones and none.
TEST_F(AllocationTest, DoesNotHappenWithAHand) {
  config_.robots[0].spec = test::FixtureRobotWithHand();
  config_.robots[0].spec.dynamics.delay = 0.005;
  port_.KeepTheLastOnly();
  StartAs("clamped");
  const robot::MotorCommand motor{.enabled = true, .q = 0.3, .kp = 20, .kd = 1, .watched = true};
  robot::RobotCommand command{.motors = {motor, motor}};
  port_.SendHandsEveryTick(command);
  CountIn(10);
  EXPECT_EQ(CountIn(1000), 0);
  command.motors[0].kp = -1;
  port_.SendHandsEveryTick(command);
  EXPECT_EQ(CountIn(1500), 0);
  EXPECT_EQ(world_->status(0).hands[0].commands.timeouts, 1U);
}

TEST_F(AllocationTest, DoesNotHappenWhereTheGroundPressesOnALinkWithAPad) {
  config_.robots[0].spec = test::FixtureRobotWithHand();
  config_.robots[0].spec.hands[0].pads = {{.site = "imu"}};
  config_.robots[0].spec.hands[0].touch.counts_per_newton = 10;
  port_.KeepTheLastOnly();
  StartAs("lying");
  CountIn(500);
  EXPECT_EQ(CountIn(500), 0);
  double force = 0;
  world_->physics().robot().HandForces({&force, 1});
  EXPECT_GT(force, 1);
}

// A whole robot: on its crane, its motion service on, 29 motors and 14 fingers, noise.
TEST_F(AllocationTest, DoesNotHappenInAG1WithHands) {
  const std::filesystem::path root(UNDERSTUDY_SOURCE_DIR);
  config_ = config::LoadConfig({.robot = "g1_29dof_dex3"}, root);
  port_.TellEvery(1);
  port_.KeepTheLastOnly();
  port_.SendHandsEveryTick(
      {.motors = std::vector<robot::MotorCommand>(7, {.enabled = true, .kp = 1, .kd = 0.1})});
  world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  CountIn(10);
  EXPECT_EQ(CountIn(500), 0);
  EXPECT_EQ(world_->status(0).hands[1].commands.accepted, 510U);
  EXPECT_EQ(world_->status(0).gate, authority::GateState::kClosed);
}

TEST_F(AllocationTest, DoesNotHappenInAG1WithTwoInspireHandsWhichTellsEachLowState) {
  const std::filesystem::path root(UNDERSTUDY_SOURCE_DIR);
  config_ = config::LoadConfig({.robot = "g1", .sets = {"robot.hand_make=inspire"}}, root);
  port_.TellEvery(1);
  port_.KeepTheLastOnly();
  port_.SendHandsEveryTick(
      {.motors = std::vector<robot::MotorCommand>(12, {.enabled = true, .q = 0.5})});
  world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  CountIn(10);
  EXPECT_EQ(CountIn(500), 0);
  EXPECT_EQ(world_->status(0).hands[0].commands.accepted, 510U);
  EXPECT_EQ(world_->status(0).published, 510U);
}

// Objects lie, are put elsewhere, roll, are met by a robot and watched.
TEST_F(AllocationTest, DoesNotHappenAmongObjects) {
  config_ = config::LoadConfig(
      {.robot = "go2",
       .sets = {"start.pose=standing",
                "objects=[{kind: table, pos: [2, 0, 0]}, {kind: cube, pos: [2, 0, 0.75]}, {kind: "
                "ball, pos: [0.6, 0, 0]}, {kind: chair, pos: [0, 1, 0]}]"}},
      UNDERSTUDY_SOURCE_DIR);
  port_.TellEvery(1);
  port_.KeepTheLastOnly();
  world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  script::Play(
      script::ReadEvents(schema::ParseYaml("[{when: object.height(cube) > 9, clamp: on}]", "s"),
                         signals::RunningNames()),
      world_.get());
  Ask("remote.sticks", {{"ly", 0.5}, {"for", 3}});
  CountIn(10);
  Ask("object", {{"object", "cube"}, {"pos", {0.4, 0, 1}}});
  EXPECT_EQ(CountIn(2000), 0);
}

// A cart pushes a crate, a person turns in its corners, and a reset puts them back.
TEST_F(AllocationTest, DoesNotHappenAmongPeopleAndCarts) {
  config_ = config::LoadConfig(
      {.robot = "go2",
       .sets = {"start.pose=standing",
                "objects=[{kind: cart, pos: [0, 2, 0], path: [{to: [2, 2]}]}, {kind: crate, pos: "
                "[0.8, 2, 0]}, {kind: person, pos: [2, 0, 0], path: [{to: [2, 0.3]}]}]"}},
      UNDERSTUDY_SOURCE_DIR);
  port_.TellEvery(1);
  port_.KeepTheLastOnly();
  world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
  CountIn(10);
  EXPECT_EQ(CountIn(1500), 0);
  Ask("reset");
  CountIn(1);
  EXPECT_EQ(CountIn(100), 0);
}

// From its stand into a trot, through a bend, and to a stand again; wheels roll and step.
TEST_F(AllocationTest, DoesNotHappenInAQuadrupedThatWalks) {
  const std::filesystem::path root(UNDERSTUDY_SOURCE_DIR);
  for (const char* robot : {"go2", "go2w"}) {
    config_ = config::LoadConfig({.robot = robot, .sets = {"start.pose=standing"}}, root);
    port_.TellEvery(1);
    port_.KeepTheLastOnly();
    world_ = MakeIn(assembly::MakePhysics(&config_).world, &port_, &inbox_);
    world_->Play({{.at = 0.2,
                   .request = test::RequestOf("remote.sticks",
                                              {{"ly", 0.5}, {"lx", -0.3}, {"rx", 0.3}, {"for", 3}}),
                   .where = ""}});
    CountIn(10);
    EXPECT_EQ(CountIn(4500), 0) << robot;
    EXPECT_GT(world_->robot(0).sampled().base.p_WB.head<2>().norm(), 0.2) << robot;
  }
}

TEST_F(AllocationTest, DoesNotHappenForAStatus) {
  Start();
  CountIn(10);
  const std::int64_t before = allocations;
  const Status status = world_->status(0);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_EQ(status.steps, 10);
}

TEST_F(AllocationTest, DoesNotHappenForASnapshot) {
  StartAs("standing");
  Ask("push", {{"force", {1, 0, 0}}, {"for", 1}});
  robot::RobotCommand command = Torque(1);
  command.motors[2].tau = NAN;
  port_.SendEveryTick(command);
  CountIn(10);
  Snapshot snapshot = world_->MakeSnapshot(0);
  snapshot.parts = kAllSnapshotParts;
  const std::int64_t before = allocations;
  for (int i = 0; i < 10; ++i) world_->Show(&snapshot);
  EXPECT_EQ(allocations - before, 0);
  EXPECT_FALSE(snapshot.contacts.empty());
  EXPECT_FALSE(Told(EventKind::kRefused).empty());
}

}  // namespace
}  // namespace understudy::emulator
