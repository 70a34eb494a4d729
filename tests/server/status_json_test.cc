#include "server/status_json.h"

#include <limits>

#include "emulator/events.h"
#include "gtest/gtest.h"
#include "tests/support/requests.h"

namespace understudy::server {
namespace {

const RobotIdentity kG1{.robot = "g1", .version = "1.2.3", .pid = 42, .log = "/tmp/a.log"};

emulator::Status EveryFieldSet() {
  emulator::Status status;
  status.loop.ready = true;
  status.silenced = true;
  status.time = 12.5;
  status.steps = 12500;
  status.speed = 0.5;
  status.paused = true;
  status.steps_left = 9;
  status.loop.pace = {.overruns = 3,
                      .lateness = 0.25,
                      .worst_lateness = 0.75,
                      .latenesses = {},
                      .shifts = 2,
                      .shifted = 1.5,
                      .real_time_factor = 0.9375};
  status.gate = authority::GateState::kFollowing;
  status.commands.accepted = 100;
  status.commands.timeouts = 2;
  status.commands.refused = {0, 11, 12, 13, 14, 15, 19, 16, 17, 18, 0, 0};
  status.arm_commands.accepted = 41;
  status.user_commands.timeouts = 42;
  status.hand_commands.accepted = 43;
  status.hands[0].name = {'l', 'e', 'f', 't'};
  status.hands[0].commands = {.accepted = 21, .refused = {0, 0, 0, 0, 0, 22}, .timeouts = 23};
  status.port = {.unused_slots = 6, .unset_heads = 7, .write_failures = 8};
  status.command_writers = 1;
  status.motion_service = {'m', 'c', 'f'};
  status.motion = {.id = 1001, .name = "damping", .mode = 7};
  status.arm_weight = 0.25;
  status.hand_weight = 0.75;
  status.remote = {.there = true, .keys = 0x220, .lx = 1, .ly = 0.5, .rx = -1, .ry = -0.5};
  status.stick_wish = {1, 2, 3};
  status.script_done = 3;
  status.script_refused = 1;
  status.script_waiting = 2;
  emulator::CopyText("s.yaml:4", &status.script_where);
  emulator::CopyText("lowcmd arrives", &status.script_waits_for);
  status.published = 12499;
  status.divergences = 4;
  status.crane_attached = true;
  status.crane_length = 0.625;
  status.crane_tension = 340.5;
  status.services.requests = 51;
  status.services.refused[static_cast<std::size_t>(services::CallRefusal::kState)] = 52;
  status.services.lost_replies = 53;
  status.power = robot::PowerState::kBooting;
  status.boots_for = 46.5;
  status.motion.dangers[static_cast<std::size_t>(robot::Danger::kHeat)].does =
      robot::Protection::kLieDown;
  emulator::CopyText("left", &status.hand_forces[0].name);
  status.hand_forces[0].force = 24.5;
  emulator::CopyText("right", &status.hand_forces[1].name);
  status.hand_forces[1].force = 25.5;
  status.clamped = true;
  status.base_height = 0.75;
  status.tilt = 0.125;
  status.loop.recording.state = emulator::RecordingState::kFailed;
  status.loop.recording.messages = 31;
  status.loop.recording.bytes = 32;
  status.loop.recording.dropped = 33;
  emulator::CopyText("/tmp/a.mcap", &status.loop.recording.file);
  return status;
}

TEST(StatusJsonTest, HoldsEveryFieldInAFixedOrder) {
  const std::string kNone =
      R"({"crc":0,"head":0,"mode_machine":0,"mode_pr":0,"motor_mode":0,"motor_count":0,)"
      R"("not_finite":0,"gain":0,"motion_service":0,"no_motion_service":0,"not_handed_over":0,"damping":0,"undecoded":0,"lost":0,"unmatched":0})";
  EXPECT_EQ(
      StatusJson(kG1, EveryFieldSet()).dump(),
      R"({"robot":"g1","name":"","version":"1.2.3","pid":42,"log":"/tmp/a.log","ready":true,"silenced":true,"time":12.5,)"
      R"("steps":12500,"speed":0.5,"paused":true,"steps_left":9,)"
      R"("pace":{"real_time_factor":0.9375,"overruns":3,)"
      R"("lateness":0.25,"worst_lateness":0.75,"shifts":2,"shifted":1.5},)"
      R"("commands":{"state":"following","accepted":100,"timeouts":2,"refused":{"crc":11,"head":12,"mode_machine":13,"mode_pr":14,)"
      R"("motor_mode":15,"motor_count":19,"not_finite":16,"gain":17,"motion_service":18,)"
      R"("no_motion_service":0,"not_handed_over":0,"damping":0,"undecoded":0,"lost":0,"unmatched":0},"unused_slots":6,)"
      R"("unset_heads":7,)"
      R"("writers":1},)"
      R"("arm_sdk":{"accepted":41,"refused":)" +
          kNone + R"(},"user_lowcmd":{"accepted":0,"timeouts":42,"refused":)" + kNone +
          R"(},"hand_sdk":{"accepted":43,"refused":)" + kNone +
          R"(},)"
          R"("hands":[{"name":"left","accepted":21,"timeouts":23,"refused":{"crc":0,"head":0,"mode_machine":0,)"
          R"("mode_pr":0,"motor_mode":22,"motor_count":0,"not_finite":0,"gain":0,"motion_service":0,)"
          R"("no_motion_service":0,"not_handed_over":0,"damping":0,"undecoded":0,"lost":0,"unmatched":0}}],)"
          R"("hand_force":{"left":24.5,"right":25.5},)"
          R"("services":{"requests":51,"refused":{"unknown_api":0,"lease":0,"parameter":0,"state":52,"ignored":0,"goal":0,)"
          R"("name":0,"protected":0,"not_simulated":0,"failed":0,"code":0,"not_served":0,"undecoded":0,)"
          R"("too_many":0,"unmatched":0},"lost_replies":53},)"
          R"("power":"booting","boots_for":46.5,)"
          R"("motion":{"service":"mcf","state":1001,"name":"damping","mode":7,"protects":["heat"],"arm_weight":0.25,"hand_weight":0.75},)"
          R"("remote":{"there":true,"keys":"L2+B","lx":1.0,"ly":0.5,"rx":-1.0,"ry":-0.5,"wish":[1.0,2.0,3.0]},)"
          R"("script":{"done":3,"refused":1,"waiting":2,"where":"s.yaml:4","waits_for":"lowcmd arrives"},)"
          R"("published":12499,"write_failures":8,"divergences":4,"crane":{"attached":true,)"
          R"("length":0.625,"tension":340.5},"clamped":true,"base":{"height":0.75,"tilt":0.125},)"
          R"("recording":{"state":"failed","file":"/tmp/a.mcap","messages":31,"bytes":32,"dropped":33},"randomization":null,"unserved":[]})");
}

TEST(StatusJsonTest, NamesEveryStateOfTheGate) {
  emulator::Status status;
  status.gate = authority::GateState::kStart;
  EXPECT_EQ(StatusJson(kG1, status)["commands"]["state"], "start");
  status.gate = authority::GateState::kFollowing;
  EXPECT_EQ(StatusJson(kG1, status)["commands"]["state"], "following");
  status.gate = authority::GateState::kDamping;
  EXPECT_EQ(StatusJson(kG1, status)["commands"]["state"], "damping");
  status.gate = authority::GateState::kLimp;
  EXPECT_EQ(StatusJson(kG1, status)["commands"]["state"], "limp");
  status.gate = authority::GateState::kClosed;
  EXPECT_EQ(StatusJson(kG1, status)["commands"]["state"], "motion_service");
}

TEST(StatusJsonTest, BeforeTheFirstPostNothingIsReadyAndNothingRefused) {
  const auto told = StatusJson(kG1, emulator::StatusBoard{}.Read());
  EXPECT_EQ(told["ready"], false);
  EXPECT_EQ(told["commands"]["refused"]["crc"], 0);
}

TEST(StatusJsonTest, ANumberThatIsNotFiniteBecomesNull) {
  emulator::Status status;
  status.tilt = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(StatusJson(kG1, status).dump().find(R"("tilt":null)"), std::string::npos);
}

TEST(StatusJsonTest, TellsWhatTheRunLeftToChance) {
  RobotIdentity identity = kG1;
  identity.draws = {.seed = 7,
                    .values = {{"friction", "", 0.5}, {"mass", "a", 1.25}, {"mass", "b", 0.75}}};
  EXPECT_EQ(StatusJson(identity, {})["randomization"].dump(),
            R"({"seed":7,"drawn":{"friction":0.5,"mass":{"a":1.25,"b":0.75}}})");
}

TEST(TimingsJsonTest, TellsWhatIsMeasured) {
  emulator::Status status;
  status.steps = 2;
  status.loop.pace.overruns = 1;
  status.loop.ticks.Add(15e-6);
  status.loop.ticks.Add(1);
  using nlohmann::json;
  const json timings = TimingsJson(status);
  EXPECT_EQ(timings["steps"], 2);
  EXPECT_EQ(timings["overruns"], 1);
  EXPECT_EQ(timings["tick"]["count"], 2);
  EXPECT_EQ(timings["tick"]["buckets"][2], json({{"le", 2e-5}, {"count", 1}}));
  EXPECT_EQ(timings["tick"]["buckets"].back(), json({{"count", 1}}));
  EXPECT_EQ(timings["late"]["count"], 0);
  EXPECT_EQ(timings["late"]["mean"], 0.0);
}

}  // namespace
}  // namespace understudy::server
