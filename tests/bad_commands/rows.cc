#include "tests/bad_commands/rows.h"

#include <cmath>
#include <limits>
#include <memory>
#include <thread>

#include <gtest/gtest.h>

#include "robot/robot_values.h"
#include "tests/bus/garbage_writer.h"
#include "tests/support/eventually.h"
#include "wire/topics.h"

namespace understudy::bad_commands {
namespace {

using authority::GateState;
using robot::Refusal;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr std::string_view kAssumed = "*assumed*", kVendor = "vendor", kMeasured = "measured";
constexpr int kTimeout_ms = 200;  // gate.timeout

bool IsGo(const robot::RobotSpec& spec) { return spec.family == robot::WireFamily::kGo; }
bool IsHg(const robot::RobotSpec& spec) { return !IsGo(spec); }

using Edit = std::function<void(Message*, const Rig&)>;
using Play = std::function<void(Rig*)>;

std::size_t SlotOf(const Rig& rig, std::size_t motor) {
  return wire::SlotOf(rig.spec().motors[motor]);
}

// Edits the slot of the first motor, or of the last.
Edit First(std::function<void(Slot*)> edit) {
  return [=](Message* message, const Rig& rig) { edit(&message->slots[SlotOf(rig, 0)]); };
}
Edit Last(std::function<void(Slot*)> edit) {
  return [=](Message* message, const Rig& rig) {
    edit(&message->slots[SlotOf(rig, rig.spec().motors.size() - 1)]);
  };
}
// Edits those of all motors.
Edit Each(std::function<void(Slot*)> edit) {
  return [=](Message* message, const Rig& rig) {
    for (std::size_t i = 0; i < rig.spec().motors.size(); ++i) {
      edit(&message->slots[SlotOf(rig, i)]);
    }
  };
}
Edit Whole(std::function<void(Message*)> edit) {
  return [=](Message* message, const Rig&) { edit(message); };
}

// A good command is followed, the bad one refused: the good one goes on.
Play Refused(Refusal refusal, const Edit& edit) {
  return [=](Rig* rig) {
    const Message good = rig->Reach(0.01);
    rig->Send(good);
    rig->Tick(25);
    Message bad = rig->Reach(0.3);
    edit(&bad, *rig);
    rig->Send(bad);
    rig->Tick(25);
    EXPECT_EQ(rig->refused(refusal), 1U);
    EXPECT_EQ(rig->refused(), 1U);
    EXPECT_EQ(rig->accepted(), 1U);
    EXPECT_EQ(rig->commanded(), good.slots[SlotOf(*rig, 0)].q);
    EXPECT_EQ(rig->gate(), GateState::kFollowing);
  };
}

// It is taken like any; `expect` says what follows within 50 ms.
Play Taken(const Edit& edit, const std::function<void(Rig*)>& expect = {}) {
  return [=](Rig* rig) {
    Message bad = rig->Reach(0.3);
    edit(&bad, *rig);
    rig->Send(bad);
    rig->Tick(50);
    EXPECT_EQ(rig->accepted(), 1U);
    EXPECT_EQ(rig->refused(), 0U);
    EXPECT_EQ(rig->gate(), GateState::kFollowing);
    if (expect) expect(rig);
  };
}

void GivesNoTorque(Rig* rig) { EXPECT_LT(rig->largest_torque(), 1e-9); }
// All motors at once, among which the battery's current is shared.
void GivesMuchTorque(Rig* rig) {
  EXPECT_GT(rig->largest_torque(), 0.3 * rig->spec().motors[0].torque_limit);
}

// Writes good commands for so long, `at_once` of them every `every_ms`.
void Write(Rig* rig, int ms, int every_ms, int at_once = 1) {
  const Message good = rig->Reach(0);
  for (int t = 0; t < ms; t += every_ms) {
    for (int i = 0; i < at_once; ++i) rig->Send(good);
    rig->Tick(every_ms);
  }
}

// By a writer of that kind.
Play TakenFrom(const WriterKind& kind) {
  return [=](Rig* rig) {
    const auto writer = rig->Join(kind);
    writer->Write(rig->Reach(0));
    rig->Tick(5);
    EXPECT_EQ(rig->accepted(), 1U);
    EXPECT_EQ(rig->refused(), 0U);
  };
}
Play NotHeard(const std::function<std::unique_ptr<Writer>(Rig*)>& join) {
  return [=](Rig* rig) {
    const auto writer = join(rig);
    writer->Write(rig->Reach(0.3));
    rig->Tick(50);
    EXPECT_EQ(rig->accepted(), 0U);
    EXPECT_EQ(rig->gate(), GateState::kStart);
  };
}

// Bytes that are no LowCmd, under its name, over the network.
Play Garbage(std::size_t length) {
  return [=](Rig* rig) {
    const bus::GarbageWriter garbage(
        rig->host(), "rt/lowcmd",
        rig->is_go() ? *wire::kGoLowCmd.descriptor : *wire::kHgLowCmd.descriptor);
    EXPECT_TRUE(test::Eventually([&] {
      garbage.Send(std::string(length, 'x'));
      rig->Tick(1);
      return rig->refused(Refusal::kUndecoded) > 0;
    }));
    // None is under way any more.
    std::uint64_t before = 0;
    do {
      before = rig->refused();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
      rig->Tick(1);
    } while (rig->refused() != before);
    EXPECT_EQ(rig->refused(), rig->refused(Refusal::kUndecoded));
    EXPECT_EQ(rig->accepted(), 0U);
  };
}

std::vector<Row> Values() {
  constexpr std::string_view kGroup = "Values", kRefused = "refused; the last good command goes on";
  const auto not_finite = [&](std::string_view sends, const Edit& edit) {
    return Row{kGroup,       sends,    kRefused,
               "not_finite", kAssumed, "what hardware does is not published",
               "",           {},       Refused(Refusal::kNotFinite, edit)};
  };
  const auto gain = [&](std::string_view sends, const Edit& edit) {
    return Row{kGroup, sends,    kRefused,
               "gain", kAssumed, "as above",
               "",     {},       Refused(Refusal::kGain, edit)};
  };
  const auto taken = [&](std::string_view sends, std::string_view reaction, std::string_view grade,
                         std::string_view source, const Play& play) {
    return Row{kGroup, sends, reaction, "", grade, source, "", {}, play};
  };
  return {
      not_finite("`q` of a motor is not a number", First([](Slot* m) { m->q = kNan; })),
      not_finite("`dq` is not a number", First([](Slot* m) { m->dq = kNan; })),
      not_finite("`tau` is not a number", First([](Slot* m) { m->tau = kNan; })),
      not_finite("`kp` is not a number", First([](Slot* m) { m->kp = kNan; })),
      not_finite("`kd` is not a number", First([](Slot* m) { m->kd = kNan; })),
      not_finite("`q` is infinite", First([](Slot* m) { m->q = kInfinity; })),
      not_finite("`tau` is minus infinite", First([](Slot* m) { m->tau = -kInfinity; })),
      not_finite("`dq` is infinite", First([](Slot* m) { m->dq = kInfinity; })),
      not_finite("`kp` is infinite", First([](Slot* m) { m->kp = kInfinity; })),
      not_finite("`kd` is infinite", First([](Slot* m) { m->kd = kInfinity; })),
      not_finite("one value of the last motor alone is not a number",
                 Last([](Slot* m) { m->dq = kNan; })),
      not_finite("a motor that is off (`mode` 0) has a `q` that is not a number",
                 First([](Slot* m) {
                   m->mode = 0;
                   m->q = kNan;
                 })),
      gain("`kp` is negative", First([](Slot* m) { m->kp = -1; })),
      gain("`kd` is negative", First([](Slot* m) { m->kd = -1; })),
      gain("`kp` is the least negative number",
           First([](Slot* m) { m->kp = -std::numeric_limits<float>::denorm_min(); })),
      taken("denormal numbers everywhere", "taken; no torque to speak of", kAssumed, "",
            Taken(Each([](Slot* m) {
                    *m = {.q = 1e-40F, .dq = 1e-40F, .tau = 1e-40F, .kp = 1e-40F, .kd = 1e-40F};
                  }),
                  [](Rig* rig) { EXPECT_LT(rig->largest_torque(), 1e-6); })),
      taken("`kp` 1e6", "taken; torque ends at the motor's limit", kAssumed,
            "a torque limit of the drive",
            Taken(Each([](Slot* m) { m->kp = 1e6F; }), GivesMuchTorque)),
      taken(
          "`kp` as large as a float goes", "taken; the same", kAssumed, "",
          Taken(Each([](Slot* m) { m->kp = std::numeric_limits<float>::max(); }), GivesMuchTorque)),
      taken("`kd` 1e6", "taken; brakes, at most with the motor's limit", kAssumed, "",
            Taken(Each([](Slot* m) { m->kd = 1e6F; }))),
      taken("`tau` 1e9 N·m", "taken; torque ends at the motor's limit", kAssumed, "",
            Taken(Each([](Slot* m) { *m = {.tau = 1e9F}; }), GivesMuchTorque)),
      taken("`q` = 2.146e9 (`PosStopF`) with a `kp`", "taken; the `kp` term is left out", kVendor,
            "sdk", Taken(Each([](Slot* m) { *m = {.q = 2.146e9F, .kp = 60}; }), GivesNoTorque)),
      taken("`dq` = 16000 (`VelStopF`) with a `kd`", "taken; the `kd` term is left out", kVendor,
            "sdk", Taken(Each([](Slot* m) { *m = {.dq = 16000, .kd = 5}; }), GivesNoTorque)),
      taken("`q` beside `PosStopF` (2.145e9) with a `kp`",
            "taken: an angle like any other; torque ends at the motor's limit", kAssumed, "",
            Taken(Each([](Slot* m) { *m = {.q = 2.145e9F, .kp = 60}; }), GivesMuchTorque)),
      taken("`mode` 0 with gains", "taken; the motor gives no torque", kVendor, "docs",
            Taken(Each([](Slot* m) { m->mode = 0; }), GivesNoTorque)),
      taken("`q` 10 rad beyond the joint's range", "taken; the joint runs into its stop and stays",
            kAssumed, "the firmware may clamp it",
            [](Rig* rig) {
              Message bad = rig->Reach(0);
              Slot& slot = bad.slots[SlotOf(*rig, 0)];
              slot.q = static_cast<float>(rig->range()[1]) + 10;
              for (int t = 0; t < 1000; t += 50) {
                rig->Send(bad);
                rig->Tick(50);
              }
              EXPECT_EQ(rig->refused(), 0U);
              EXPECT_NEAR(rig->q(), rig->range()[1], 0.1);
            }),
      taken("the first command is 0.5 rad from where the joints are", "taken; they jump there",
            kAssumed, "`ctl damage` tells the largest jump",
            [](Rig* rig) {
              const double begin = rig->q();
              const double by = begin + 0.5 < rig->range()[1] ? 0.5 : -0.5;
              rig->Send(rig->Reach(by));
              rig->Tick(150);
              EXPECT_GT((rig->q() - begin) / by, 0.5);
            }),
      taken("commands that oscillate by 0.5 rad, 500 times a second", "each is taken", kAssumed, "",
            [](Rig* rig) {
              const Message there = rig->Reach(0.5), here = rig->Reach(-0.5);
              for (int i = 0; i < 100; ++i) {
                rig->Send(i % 2 == 0 ? there : here);
                rig->Tick(1);
              }
              EXPECT_EQ(rig->accepted(), 100U);
            }),
  };
}

std::vector<Row> Form() {
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

std::vector<Row> Times() {
  constexpr std::string_view kGroup = "Times", kGate = "a time-out bit is documented, no figure";
  const auto row = [&](std::string_view sends, std::string_view reaction, std::string_view counted,
                       const Play& play) {
    return Row{kGroup, sends, reaction, counted, kAssumed, kGate, "", {}, play};
  };
  return {
      row("no command at all, for 1 s", "the start command stays", "",
          [](Rig* rig) {
            rig->Tick(1000);
            EXPECT_EQ(rig->gate(), GateState::kStart);
            EXPECT_EQ(rig->timeouts(), 0U);
          }),
      row("one command, then silence", "damping after 0.2 s: `kd` 2 N·m·s/rad on every motor",
          "timeouts",
          [](Rig* rig) {
            Write(rig, kTimeout_ms - 20, kTimeout_ms - 20);
            EXPECT_EQ(rig->gate(), GateState::kFollowing);
            rig->Tick(40);
            EXPECT_EQ(rig->gate(), GateState::kDamping);
            EXPECT_EQ(rig->timeouts(), 1U);
          }),
      row("one command a second", "followed for 0.2 s of each second, damping between them",
          "timeouts",
          [](Rig* rig) {
            Write(rig, 3000, 1000);
            EXPECT_EQ(rig->accepted(), 3U);
            EXPECT_EQ(rig->timeouts(), 3U);
          }),
      row("commands that come 0.15 s apart", "followed throughout", "",
          [](Rig* rig) {
            Write(rig, 1500, 150);
            EXPECT_EQ(rig->timeouts(), 0U);
            EXPECT_EQ(rig->gate(), GateState::kFollowing);
          }),
      row("a program that is stopped (SIGSTOP) for 0.5 s and goes on",
          "damping, and following from its next command on", "timeouts",
          [](Rig* rig) {
            Write(rig, 100, 2);
            rig->Tick(500);
            EXPECT_EQ(rig->gate(), GateState::kDamping);
            Write(rig, 100, 2);
            EXPECT_EQ(rig->gate(), GateState::kFollowing);
            EXPECT_EQ(rig->timeouts(), 1U);
          }),
      row("a program that is killed: its writer is gone", "damping after 0.2 s", "timeouts",
          [](Rig* rig) {
            {
              const auto program = rig->Join();
              program->Write(rig->Reach(0));
              rig->Tick(10);
              EXPECT_EQ(rig->gate(), GateState::kFollowing);
            }
            rig->Tick(kTimeout_ms);
            EXPECT_EQ(rig->gate(), GateState::kDamping);
          }),
      row("good commands that turn bad (`crc`) and keep coming",
          "damping after 0.2 s: refused ones do not count", "crc",
          [](Rig* rig) {
            Write(rig, 20, 2);
            Message bad = rig->Reach(0);
            bad.crc = Message::Crc::kWrongBit;
            for (int t = 0; t < kTimeout_ms + 20; t += 2) {
              rig->Send(bad);
              rig->Tick(2);
            }
            EXPECT_EQ(rig->gate(), GateState::kDamping);
            EXPECT_EQ(rig->refused(Refusal::kCrc), 110U);
          }),
      row("10,000 commands a second",
          "8 are taken a millisecond, the rest lost; the newest is followed within 2 ms", "lost",
          [](Rig* rig) {
            Write(rig, 100, 1, 10);
            const Message newest = rig->Reach(0.1);
            rig->Send(newest);
            rig->Tick(25);
            EXPECT_EQ(rig->accepted() + rig->refused(Refusal::kLost), 1001U);
            EXPECT_GT(rig->refused(Refusal::kLost), 100U);
            EXPECT_EQ(rig->commanded(), newest.slots[SlotOf(*rig, 0)].q);
          }),
      row("200 commands at once", "the newest 16 are taken, the others lost", "lost",
          [](Rig* rig) {
            for (int i = 0; i < 200; ++i) rig->Send(rig->Reach(0));
            rig->Tick(5);
            EXPECT_EQ(rig->accepted(), 16U);
            EXPECT_EQ(rig->refused(Refusal::kLost), 184U);
          }),
      row("1000 commands at once",
          "the same; 240 are counted, since Cyclone keeps 256 and does not tell what it replaced",
          "lost",
          [](Rig* rig) {
            for (int i = 0; i < 1000; ++i) rig->Send(rig->Reach(0));
            rig->Tick(5);
            EXPECT_EQ(rig->accepted(), 16U);
            EXPECT_EQ(rig->refused(Refusal::kLost), 240U);
          }),
  };
}

std::vector<Row> Writers() {
  constexpr std::string_view kGroup = "Writers and bytes";
  constexpr std::string_view kReader = "readers of real robots: best effort, volatile";
  const auto taken = [&](std::string_view sends, const WriterKind& kind) {
    return Row{kGroup, sends, "taken", "", kVendor, kReader, "", {}, TakenFrom(kind)};
  };
  const auto not_heard = [&](std::string_view sends,
                             const std::function<std::unique_ptr<Writer>(Rig*)>& join) {
    return Row{kGroup, sends, "nothing of it arrives", "unmatched", kVendor, "DDS",
               "",     {},    NotHeard(join)};
  };
  const auto of_kind = [](const WriterKind& kind) {
    return [kind](Rig* rig) { return rig->Join(kind); };
  };
  return {
      {kGroup,
       "two programs command in turn",
       "both are followed, the newest wins",
       "",
       kVendor,
       "docs: no arbitration",
       "",
       {},
       [](Rig* rig) {
         const auto other = rig->Join();
         const Message here = rig->Reach(0), there = rig->Reach(0.1);
         for (int i = 0; i < 50; ++i) {
           rig->Send(here);
           rig->Tick(1);
           other->Write(there);
           rig->Tick(1);
         }
         rig->Tick(20);
         EXPECT_EQ(rig->accepted(), 100U);
         EXPECT_EQ(rig->commanded(), there.slots[SlotOf(*rig, 0)].q);
         EXPECT_EQ(rig->status().command_writers, 2);
       }},
      taken("its writer is best effort", {.reliable = false}),
      taken("its writer is transient local", {.transient_local = true}),
      taken("its writer keeps all", {.keep_all = true}),
      taken("its writer speaks XCDR2", {.representation = DDS_DATA_REPRESENTATION_XCDR2}),
      not_heard("its writer is in another partition", of_kind({.partition = "elsewhere"})),
      not_heard("its writer has exclusive ownership", of_kind({.exclusive = true})),
      not_heard("its `LowCmd_` is the other family's",
                [](Rig* rig) { return rig->JoinAsOtherFamily(); }),
      {kGroup,
       "bytes that end too soon, under the name of `LowCmd_`",
       "refused",
       "undecoded",
       kAssumed,
       "",
       "",
       {},
       Garbage(7)},
      {kGroup,
       "10,000 bytes that are no `LowCmd_`, under its name",
       "refused, unread",
       "undecoded",
       kAssumed,
       "",
       "",
       {},
       Garbage(10'000)},
  };
}

}  // namespace

const std::vector<Row>& Rows() {
  static const std::vector<Row> rows = [] {
    std::vector<Row> all;
    for (auto* group : {&Values, &Form, &Times, &Writers}) {
      for (Row& row : group()) all.push_back(std::move(row));
    }
    return all;
  }();
  return rows;
}

std::string Reference() {
  std::string text =
      "# Bad commands\n\n"
      "Written by the table of `tests/bad_commands`, which does all of it over DDS to every robot, "
      "clamped, and expects what stands here; the next good command is followed then. Throughout, "
      "no motor gives more than its limit, the physics goes well, and `rt/lowstate` goes on with "
      "finite values. The word is that of `understudy ctl status` under which it is counted "
      "(`unmatched` by the "
      "daemon, which looks for such writers, and in its own test, `tests/system/test_log.py`; "
      "`tests/system/test_stopped_program.py` stops and kills programs as processes). "
      "Grades and sources are those of [fidelity.md](fidelity.md).\n\n"
      "Where no robot is named it is all of them; go and hg are the families of messages. Times "
      "are simulated.\n";
  std::string_view group;
  for (const Row& row : Rows()) {
    if (row.group != group) {
      group = row.group;
      text.append("\n## ").append(group).append("\n\n");
      text +=
          "| a program sends | robots | the robot | counted as | grade | source |\n"
          "|---|---|---|---|---|---|\n";
    }
    text.append("| ").append(row.sends).append(" | ").append(row.robots).append(" | ");
    text.append(row.reaction).append(" | ");
    if (!row.counted.empty()) text.append("`").append(row.counted).append("`");
    text.append(" | ").append(row.grade).append(" | ").append(row.source).append(" |\n");
  }
  return text;
}

}  // namespace understudy::bad_commands
