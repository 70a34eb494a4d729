#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

ServiceTable Go2SportTable(std::string_view title, const MoveLimits& limits) {
  constexpr std::string_view kSdk = "[sdk] go2/sport";
  constexpr std::string_view kDocs = "[sdk] go2/sport; [docs] Go2 motion services V2.0";
  constexpr std::string_view kPosture =
      "[sdk] go2/sport; [docs] 4206 when the posture does not allow it";
  constexpr std::int32_t kPostureUnfit = 4206;
  const auto gesture = [&](std::int64_t id, std::string_view name, authority::GoalMaker goal,
                           std::string_view does) {
    return ApiRow{.id = id,
                  .name = name,
                  .effect = AskGoal{.goal = goal, .not_now = kPostureUnfit},
                  .does = does,
                  .source = kPosture};
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
              {1001,
               "Damp",
               {},
               AskGoal{To<goal::Damp>},
               "all joints damped, from every state",
               kDocs},
              {1002,
               "BalanceStand",
               {},
               AskGoal{To<goal::BalanceStand>},
               "stands and balances",
               kDocs},
              {1003, "StopMove", {}, AskGoal{To<goal::StopMove>}, "stops walking", kDocs},
              {1004, "StandUp", {}, AskGoal{To<goal::StandUp>}, "stands with locked joints", kDocs},
              {1005, "StandDown", {}, AskGoal{To<goal::StandDown>}, "lies down", kDocs},
              {1006,
               "RecoveryStand",
               {},
               AskGoal{To<goal::RecoveryStand>},
               "stands up from anywhere",
               kDocs},
              {1007,
               "Euler",
               {Clamped("x", 0.75), Clamped("y", 0.75), Clamped("z", 0.6)},
               AskGoal{To<goal::Euler>},
               "roll, pitch, yaw of the body, rad",
               "[sdk] go2/sport; [docs] ranges; that more is clamped is assumed"},
              {1008,
               "Move",
               {Clamped("x", limits.vx_min, limits.vx_max), Clamped("y", limits.vy),
                Clamped("z", limits.yaw_rate)},
               AskGoal{.goal = To<goal::Move>, .then = {limits.hold}},
               "velocity, m/s and rad/s, for 1 s; clients want no reply",
               "[sdk] go2/sport; [docs] ranges and hold; that more is clamped is assumed"},
              gesture(1009, "Sit", To<goal::Sit>, "sits"),
              gesture(1010, "RiseSit", To<goal::RiseSit>, "rises from sitting"),
              NotPlayed(1015, "SpeedLevel", kDocs, {Int("data", -1, 1)}),
              gesture(1016, "Hello", To<goal::Hello>, "waves"),
              gesture(1017, "Stretch", To<goal::Stretch>, "stretches"),
              NotPlayed(1020, "Content", kSdk),
              NotPlayed(1022, "Dance1", kSdk),
              NotPlayed(1023, "Dance2", kSdk),
              {1027,
               "SwitchJoystick",
               {Flag()},
               Special{SwitchSticks},
               "whether the remote's sticks move the robot",
               kDocs},
              {1028,
               "Pose",
               {Flag()},
               AskGoal{.goal = To<goal::Pose>, .not_now = kPostureUnfit},
               "poses, or ends the pose",
               kPosture},
              NotPlayed(1029, "Scrape", kSdk),
              NotPlayed(1030, "FrontFlip", kSdk),
              NotPlayed(1031, "FrontJump", kSdk),
              NotPlayed(1032, "FrontPounce", kSdk),
              NotPlayed(1036, "Heart", kSdk),
              NotPlayed(1061, "StaticWalk", kSdk),
              NotPlayed(1062, "TrotRun", kSdk),
              NotPlayed(1063, "EconomicGait", kSdk),
              NotPlayed(2041, "LeftFlip", kSdk),
              NotPlayed(2043, "BackFlip", kSdk),
              NotPlayed(2044, "HandStand", kSdk, {Flag()}),
              NotPlayed(2045, "FreeWalk", kSdk),
              NotPlayed(2046, "FreeBound", kSdk, {Flag()}),
              NotPlayed(2047, "FreeJump", kSdk, {Flag()}),
              NotPlayed(2048, "FreeAvoid", kSdk, {Flag()}),
              NotPlayed(2049, "ClassicWalk", kSdk, {Flag()}),
              NotPlayed(2050, "WalkUpright", kSdk, {Flag()}),
              NotPlayed(2051, "CrossStep", kSdk, {Flag()}),
              {2054,
               "AutoRecoverySet",
               {Flag()},
               AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
               "whether a fallen robot gets up by itself",
               kDocs},
              {2055,
               "AutoRecoveryGet",
               {},
               GiveSetting{"auto_recovery", "data"},
               "what was set; false at the start (assumed)",
               kDocs},
              NotPlayed(2058, "SwitchAvoidMode", kSdk),
          },
      .settings = {{"auto_recovery", "false"}},
      .note =
          "4201 when the present state does not allow it (assumed), 4205 for what is not "
          "played. Ids that firmware 1.1.6 removed (1011 to 1014, 1018, 1019, 1021, 1024 to "
          "1026) answer 3203.",
  };
}

}  // namespace understudy::services
