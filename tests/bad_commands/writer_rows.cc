// The rows on who writes and how: several programs, writers of other kinds, bytes that are none.
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bad_commands/plays.h"
#include "tests/bad_commands/rows.h"
#include "tests/bus/garbage_writer.h"
#include "tests/support/eventually.h"
#include "wire/topics.h"

namespace understudy::bad_commands {
namespace {

using authority::GateState;
using robot::Refusal;

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

}  // namespace

std::vector<Row> WriterRows() {
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
      taken("its writer uses XCDR2", {.representation = DDS_DATA_REPRESENTATION_XCDR2}),
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

}  // namespace understudy::bad_commands
