// The motion service of B2 and B2-W.
#include <string_view>

#include "services/tables/fields.h"
#include "services/tables/sport.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of
using namespace sport;   // NOLINT(google-build-using-namespace): those of sport

using enum goal::GaitName;
using authority::ToIf;

// Clients disagree: one sends three angles, the other a flag. A flag levels the body, angles
// follow.
ServiceReply FreeEuler(const ServiceCall& call) {
  const auto angle = [&](const char* key) { return call.parameter.value(key, 0.0); };
  return CodeOf(call.owner->Ask(goal::Euler{angle("x"), angle("y"), angle("z")}));
}

}  // namespace

ServiceTable B2SportTable(std::string_view title, double hold) {
  constexpr std::string_view kSdk = "[sdk] b2/sport";
  constexpr std::string_view kGait = "[sdk] b2/sport; [seen] modes 9, 18, 19 on a B2";
  return Sport(
      title, kSdk,
      {Row(1008, "Move", {Number("x"), Number("y"), Number("z")},
           AskGoal{.goal = To<goal::Move>, .then = {hold}},
           "velocity, m/s and rad/s; clients want no reply",
           "[sdk] b2/sport; 0.5 s hold of B2-W: [sdk] b2w_sport_client example; 1 s of B2 "
           "assumed; no range is published"),
       SwitchGait(kSdk),
       Row(1013, "BodyHeight", {Number()}, AskGoal{To<goal::BodyHeight>},
           "m over the own standing height; no range is published", kSdk),
       SpeedLevel(Int("data", -1, 1), "[sdk] b2/sport; range as a Go2's, assumed"),
       {.id = 1018,
        .name = "TrajectoryFollow",
        .fields = {Path("", 30)},
        .effect = Special{&FollowB2Path},
        .does = "follows the points, each to be passed at its time from now; places are "
                "those of rt/sportmodestate; clients want no reply",
        .source = "[sdk] b2/sport: 30 points, 4101 for another number; example of the "
                  "Go2's older firmware: places",
        .parameter_code = 4101},
       Row(1019, "ContinuousGait", {Flag()}, AskGoal{To<goal::KeepStepping>},
           "steps on the spot where it would stand", kSdk),
       Row(1036, "MoveToPos", {Number("x"), Number("y"), Number("yaw")}, AskGoal{To<goal::GoTo>},
           "walks there; that places are those of rt/sportmodestate is assumed", kSdk),
       Row(1038, "SwitchMoveMode", {Flag()}, AskGoal{To<goal::LastingMoves>},
           "whether a Move lasts until the next one or StopMove",
           "[sdk] b2/sport; [docs] G1 sport services, assumed to be the same"),
       NotPlayed(1039, "HandStand", kSdk, {Flag()}),
       Row(1040, "AutoRecoverySet", {Flag()},
           AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
           "whether a fallen robot gets up by itself", kSdk),
       Row(1045, "FreeWalk", {Optional(Flag())}, AskGoal{To<kFree>},
           "the default gait; frees the joints after StandUp", kGait),
       Row(1049, "ClassicWalk", {Flag()}, AskGoal{ToIf<kClassic>},
           "that gait, higher steps; false: the default one", kGait),
       Row(1050, "FastWalk", {Flag()}, AskGoal{ToIf<kFast>},
           "that gait, quicker steps; false: the default one", kGait),
       {.id = 1051,
        .name = "FreeEuler",
        .fields = {Optional(Flag()), Optional(Number("x")), Optional(Number("y")),
                   Optional(Number("z"))},
        .effect = Special{&FreeEuler},
        .does = "roll, pitch, yaw of the body, rad; a flag levels it",
        .source = "[py] a flag; [sdk] b2/sport: Euler, three angles"},
       NotPlayed(1052, "FreeHeight", kSdk, {Flag()}),
       NotPlayed(1053, "GaitHeight", kSdk, {Flag()}),
       NotPlayed(1101, "VisionWalk", kSdk, {Flag()})},
      {{"auto_recovery", "false"}, {"speed_level", "0"}},
      "4201 when the present state does not allow it (assumed), 4205 for what is not "
      "played.");
}

}  // namespace understudy::services
