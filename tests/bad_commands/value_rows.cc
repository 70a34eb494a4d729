// The rows on values: angles, rates, torques and gains that are none, or more than there may be.
#include <limits>
#include <string_view>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bad_commands/plays.h"
#include "tests/bad_commands/rows.h"

namespace understudy::bad_commands {
namespace {

using robot::Refusal;

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

void GivesNoTorque(Rig* rig) { EXPECT_LT(rig->largest_torque(), 1e-9); }
// All motors at once, among which the battery's current is shared.
void GivesMuchTorque(Rig* rig) {
  EXPECT_GT(rig->largest_torque(), 0.3 * rig->spec().motors[0].torque_limit);
}

}  // namespace

std::vector<Row> ValueRows() {
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

}  // namespace understudy::bad_commands
