#include "tests/bad_commands/plays.h"

#include <gtest/gtest.h>

namespace understudy::bad_commands {

using authority::GateState;
using robot::Refusal;

std::size_t SlotOf(const Rig& rig, std::size_t motor) {
  return wire::SlotOf(rig.spec().motors[motor]);
}

Edit First(std::function<void(Slot*)> edit) {
  return [=](Message* message, const Rig& rig) { edit(&message->slots[SlotOf(rig, 0)]); };
}

Edit Last(std::function<void(Slot*)> edit) {
  return [=](Message* message, const Rig& rig) {
    edit(&message->slots[SlotOf(rig, rig.spec().motors.size() - 1)]);
  };
}

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

Play Taken(const Edit& edit, const std::function<void(Rig*)>& expect) {
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

}  // namespace understudy::bad_commands
