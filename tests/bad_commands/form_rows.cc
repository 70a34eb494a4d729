// The rows on the form of a command: its crc, its head, its modes, what else is in it.
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bad_commands/plays.h"
#include "tests/bad_commands/rows.h"
#include "wire/topics.h"

namespace understudy::bad_commands {
namespace {

using authority::GateState;
using robot::Refusal;

bool IsGo(const robot::RobotSpec& spec) { return spec.family == robot::WireFamily::kGo; }
bool IsHg(const robot::RobotSpec& spec) { return !IsGo(spec); }

}  // namespace

std::vector<Row> FormRows() {
  constexpr std::string_view kGroup = "Form", kRefused = "refused; the last good command goes on";
  const Play mode_0x0a_refused =
      Refused(Refusal::kMotorMode, First([](Slot* m) { m->mode = 0x0A; }));
  return {
      {kGroup,
       "a bit of `crc` is wrong",
       kRefused,
       "crc",
       kMeasured,
       "live (H1-2: silently ignored); others *assumed*",
       "",
       {},
       Refused(Refusal::kCrc, Whole([](Message* m) { m->crc = Message::Crc::kWrongBit; }))},
      {kGroup,
       "`crc` is left 0",
       kRefused,
       "crc",
       kMeasured,
       "as above",
       "",
       {},
       Refused(Refusal::kCrc, Whole([](Message* m) { m->crc = Message::Crc::kZero; }))},
      {kGroup,
       "a value is changed after `crc` was made",
       kRefused,
       "crc",
       kMeasured,
       "as above",
       "",
       {},
       Refused(Refusal::kCrc, Whole([](Message* m) { m->crc = Message::Crc::kOfAnotherMessage; }))},
      {kGroup, "`head` is AA BB", kRefused, "head", kAssumed, "docs", "go", IsGo,
       Refused(Refusal::kHead, Whole([](Message* m) {
                 m->head = {0xAA, 0xBB};
               }))},
      {kGroup, "`level_flag` is 0 (high level) under the right `head`", kRefused, "head", kAssumed,
       "docs", "go", IsGo, Refused(Refusal::kHead, Whole([](Message* m) { m->level_flag = 0; }))},
      {kGroup, "`head` and `level_flag` are left 0", "taken, and counted as `unset_heads`", "",
       kAssumed, "a client for real Go2 sends them so", "go", IsGo,
       Taken(Whole([](Message* m) {
               m->head = {0, 0};
               m->level_flag = 0;
             }),
             [](Rig* rig) { EXPECT_EQ(rig->unset_heads(), 1U); })},
      {kGroup, "`mode_machine` is left 0, as before the first state", kRefused, "mode_machine",
       kMeasured, "live (G1)", "hg",
       [](const robot::RobotSpec& spec) { return IsHg(spec) && spec.mode_machine != 0; },
       Refused(Refusal::kModeMachine, Whole([](Message* m) { m->mode_machine = 0; }))},
      {kGroup, "`mode_machine` is another robot's", kRefused, "mode_machine", kMeasured,
       "live (G1)", "hg", IsHg,
       Refused(Refusal::kModeMachine, Whole([](Message* m) { ++m->mode_machine; }))},
      {kGroup, "`mode_pr` is 2", kRefused, "mode_pr", kAssumed, "docs", "hg", IsHg,
       Refused(Refusal::kModePr, Whole([](Message* m) { m->mode_pr = 2; }))},
      {kGroup,
       "a motor's `mode` is 255",
       kRefused,
       "motor_mode",
       kAssumed,
       "docs",
       "",
       {},
       Refused(Refusal::kMotorMode, First([](Slot* m) { m->mode = 255; }))},
      {kGroup, "a motor's `mode` is 0x0A", kRefused, "motor_mode", kAssumed, "docs", "hg", IsHg,
       mode_0x0a_refused},
      {kGroup, "a motor's `mode` is 0x0A", "taken as 1", "", kVendor, "sdk (H1, B2)", "go", IsGo,
       Taken(First([](Slot* m) { m->mode = 0x0A; }))},
      {kGroup, "gains in a slot without a motor", "taken, and counted as `unused_slots`", "",
       kAssumed, "", "those with such a slot",
       [](const robot::RobotSpec& spec) {
         return spec.motors.back().slot + 1 <
                static_cast<int>(IsGo(spec) ? wire::kGoMotorSlots : wire::kHgMotorSlots);
       },
       Taken(Whole([](Message* m) { m->slots.back().kp = 20; }),
             [](Rig* rig) { EXPECT_EQ(rig->unused_slots(), 1U); })},
      {kGroup,
       "`led`, `fan`, `gpio`, `bms_cmd`, `wireless_remote`, `reserve` hold 0xA5",
       "taken; neither checked nor obeyed",
       "",
       kAssumed,
       "docs (`led`, `fan`: ignored)",
       "",
       {},
       Taken(Whole([](Message* m) { m->rest = 0xA5; }))},
      {kGroup, "a good command while a motion service is on", "refused; the service goes on",
       "motion_service", kMeasured, "live (H1-2); a G1 jitters, by the docs",
       "those with a motion service",
       [](const robot::RobotSpec& spec) { return spec.kind != robot::RobotKind::kOther; },
       [](Rig* rig) {
         rig->Send(rig->Reach(0.3));
         rig->Tick(25);
         EXPECT_EQ(rig->refused(Refusal::kMotionService), 1U);
         EXPECT_EQ(rig->accepted(), 0U);
         EXPECT_EQ(rig->gate(), GateState::kClosed);
       },
       true},
  };
}

}  // namespace understudy::bad_commands
