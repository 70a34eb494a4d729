#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

ServiceTable B2SportTable(std::string_view title, const MoveLimits& limits) {
  constexpr std::string_view kSdk = "[sdk] b2/sport";
  return {
      .name = "sport",
      .title = title,
      .api_version = "1.0.0.1",
      .parameter_code = kRpcApiParameter,
      .codes = {.not_now = 4201, .unknown = kRpcApiParameter, .unable = 4205},
      .needs_motion = true,
      .rows =
          {
              {1001,
               "Damp",
               {},
               AskGoal{To<goal::Damp>},
               "all joints damped, from every state",
               kSdk},
              {1002,
               "BalanceStand",
               {},
               AskGoal{To<goal::BalanceStand>},
               "stands and balances",
               kSdk},
              {1003, "StopMove", {}, AskGoal{To<goal::StopMove>}, "stops walking", kSdk},
              {1004, "StandUp", {}, AskGoal{To<goal::StandUp>}, "stands with locked joints", kSdk},
              {1005, "StandDown", {}, AskGoal{To<goal::StandDown>}, "lies down", kSdk},
              {1006,
               "RecoveryStand",
               {},
               AskGoal{To<goal::RecoveryStand>},
               "stands up from anywhere",
               kSdk},
              {1008,
               "Move",
               {Number("x"), Number("y"), Number("z")},
               AskGoal{.goal = To<goal::Move>, .then = {limits.hold}},
               "velocity, m/s and rad/s; clients want no reply",
               "[sdk] b2/sport; 0.5 s hold of B2-W: [sdk] b2w_sport_client example; 1 s of B2 "
               "assumed; no range is published"},
              NotPlayed(1011, "SwitchGait", kSdk, {Int()}),
              {1013,
               "BodyHeight",
               {Number()},
               AskGoal{To<goal::BodyHeight>},
               "m over the own standing height; no range is published",
               kSdk},
              NotPlayed(1015, "SpeedLevel", "[sdk] b2/sport; range as a Go2's, assumed",
                        {Int("data", -1, 1)}),
              {.id = 1018,
               .name = "TrajectoryFollow",
               .fields = {Path("", 30)},
               .effect = NoController{},
               .does = "not played; clients want no reply",
               .source = "[sdk] b2/sport: 30 points, 4101 for another number",
               .parameter_code = 4101},
              NotPlayed(1019, "ContinuousGait", kSdk, {Flag()}),
              NotPlayed(1036, "MoveToPos", kSdk, {Number("x"), Number("y"), Number("yaw")}),
              NotPlayed(1038, "SwitchMoveMode", kSdk, {Flag()}),
              NotPlayed(1039, "HandStand", kSdk, {Flag()}),
              {1040,
               "AutoRecoverySet",
               {Flag()},
               AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
               "whether a fallen robot gets up by itself",
               kSdk},
              NotPlayed(1045, "FreeWalk", kSdk, {Optional(Flag())}),
              NotPlayed(1049, "ClassicWalk", kSdk, {Flag()}),
              NotPlayed(1050, "FastWalk", kSdk, {Flag()}),
              {.id = 1051,
               .name = "FreeEuler",
               .fields = {Optional(Flag()), Optional(Number("x")), Optional(Number("y")),
                          Optional(Number("z"))},
               .effect = NoController{},
               .does = "not played",
               .source = "[py] a flag; [sdk] b2/sport: Euler, three angles"},
              NotPlayed(1052, "FreeHeight", kSdk, {Flag()}),
              NotPlayed(1053, "GaitHeight", kSdk, {Flag()}),
              NotPlayed(1101, "VisionWalk", kSdk, {Flag()}),
          },
      .settings = {{"auto_recovery", "false"}},
      .note =
          "4201 when the present state does not allow it (assumed), 4205 for what is not "
          "played.",
  };
}

}  // namespace understudy::services
