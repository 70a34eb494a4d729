#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy {

using enum MotionAction;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

ServiceTable B2SportTable(std::string_view title, const MoveLimits& limits) {
  constexpr std::string_view kSdk = "[sdk] b2/sport";
  const auto without = [&](std::int64_t id, std::string_view name, std::vector<Field> schema) {
    return ApiRow{.id = id,
                  .name = name,
                  .fields = std::move(schema),
                  .effect = NoController{},
                  .does = "not played",
                  .source = kSdk};
  };
  return {
      .name = "sport",
      .title = title,
      .api_version = "1.0.0.1",
      .parameter_code = kRpcApiParameter,
      .codes = {.not_now = 4201, .unknown = kRpcApiParameter, .unable = 4205},
      .needs_motion = true,
      .rows =
          {
              {1001, "Damp", {}, AskGoal{kDamp}, "all joints damped, from every state", kSdk},
              {1002, "BalanceStand", {}, AskGoal{kBalanceStand}, "stands and balances", kSdk},
              {1003, "StopMove", {}, AskGoal{kStopMove}, "stops walking", kSdk},
              {1004, "StandUp", {}, AskGoal{kStandUp}, "stands with locked joints", kSdk},
              {1005, "StandDown", {}, AskGoal{kStandDown}, "lies down", kSdk},
              {1006, "RecoveryStand", {}, AskGoal{kRecoveryStand}, "stands up from anywhere", kSdk},
              {1008,
               "Move",
               {Number("x"), Number("y"), Number("z")},
               AskGoal{.action = kMove, .then = {limits.hold}},
               "velocity, m/s and rad/s; clients want no reply",
               "[sdk] b2/sport; 0.5 s hold of B2-W: [sdk] b2w_sport_client example; 1 s of B2 "
               "assumed; no range is published"},
              without(1011, "SwitchGait", {Int()}),
              {1013,
               "BodyHeight",
               {Number()},
               AskGoal{kBodyHeight},
               "m over the own standing height; no range is published",
               kSdk},
              {1015,
               "SpeedLevel",
               {Int("data", -1, 1)},
               KeepSetting{"speed_level"},
               "kept",
               "[sdk] b2/sport; range as a Go2's, assumed"},
              {.id = 1018,
               .name = "TrajectoryFollow",
               .fields = {Path("", 30)},
               .effect = NoController{},
               .does = "not played; clients want no reply",
               .source = "[sdk] b2/sport: 30 points, 4101 for another number",
               .parameter_code = 4101},
              without(1019, "ContinuousGait", {Flag()}),
              without(1036, "MoveToPos", {Number("x"), Number("y"), Number("yaw")}),
              without(1038, "SwitchMoveMode", {Flag()}),
              without(1039, "HandStand", {Flag()}),
              {1040,
               "AutoRecoverySet",
               {Flag()},
               AskGoal{.action = kAutoRecovery, .keep = "auto_recovery"},
               "whether a fallen robot gets up by itself",
               kSdk},
              without(1045, "FreeWalk", {Optional(Flag())}),
              without(1049, "ClassicWalk", {Flag()}),
              without(1050, "FastWalk", {Flag()}),
              {.id = 1051,
               .name = "FreeEuler",
               .fields = {Optional(Flag()), Optional(Number("x")), Optional(Number("y")),
                          Optional(Number("z"))},
               .effect = NoController{},
               .does = "not played",
               .source = "[py] a flag; [sdk] b2/sport: Euler, three angles"},
              without(1052, "FreeHeight", {Flag()}),
              without(1053, "GaitHeight", {Flag()}),
              without(1101, "VisionWalk", {Flag()}),
          },
      .settings = {{"speed_level", "0"}, {"auto_recovery", "false"}},
      .note =
          "4201 when the present state does not allow it (assumed), 4205 for what is not "
          "played.",
  };
}

}  // namespace understudy
