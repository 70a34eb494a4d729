// The rows on when commands come: never, seldom, no more, too many.
#include <cstddef>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bad_commands/plays.h"
#include "tests/bad_commands/rows.h"

namespace understudy::bad_commands {
namespace {

using authority::GateState;
using robot::Refusal;

constexpr int kTimeout_ms = 200;  // gate.timeout

// Writes good commands for so long, `at_once` of them every `every_ms`.
void Write(Rig* rig, int ms, int every_ms, int at_once = 1) {
  const Message good = rig->Reach(0);
  for (int t = 0; t < ms; t += every_ms) {
    for (int i = 0; i < at_once; ++i) rig->Send(good);
    rig->Tick(every_ms);
  }
}

}  // namespace

std::vector<Row> TimeRows() {
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

}  // namespace understudy::bad_commands
