// The motion services of quadrupeds: sport of Go2, B2 and A2 with their kin.
#include <algorithm>
#include <iterator>

#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

// Of the row SwitchJoystick.
ServiceReply SwitchSticks(const ServiceCall& call) {
  call.owner->SetSticks(call.parameter.at("data").get<bool>());
  return {};
}

// What all of them have alike, the first six apis among it, and then the `further` ones.
ServiceTable Sport(std::string_view title, std::string_view source, std::vector<ApiRow> further,
                   std::vector<std::pair<std::string_view, std::string_view>> settings,
                   std::string_view note) {
  ServiceTable table{
      .name = "sport",
      .title = title,
      .api_version = "1.0.0.1",
      .parameter_code = kRpcApiParameter,
      .codes = {.not_now = 4201, .unknown = kRpcApiParameter, .unable = 4205},
      .needs_motion = true,
      .rows = {Row(1001, "Damp", {}, AskGoal{To<goal::Damp>}, "all joints damped, from every state",
                   source),
               Row(1002, "BalanceStand", {}, AskGoal{To<goal::BalanceStand>}, "stands and balances",
                   source),
               Row(1003, "StopMove", {}, AskGoal{To<goal::StopMove>}, "stops walking", source),
               Row(1004, "StandUp", {}, AskGoal{To<goal::StandUp>}, "stands with locked joints",
                   source),
               Row(1005, "StandDown", {}, AskGoal{To<goal::StandDown>}, "lies down", source),
               Row(1006, "RecoveryStand", {}, AskGoal{To<goal::RecoveryStand>},
                   "stands up from anywhere", source)},
      .settings = std::move(settings),
      .note = note};
  std::ranges::move(further, std::back_inserter(table.rows));
  return table;
}

std::string AsText(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// The vendor's client reads every value as a text and asks for the keys below.
ServiceReply GiveA2State(const ServiceCall& call) {
  const robot::MotionState state = call.owner->state();
  const Settings& settings = *call.settings;
  const nlohmann::json reply = {
      {"fsm_id", std::to_string(state.id)},
      {"fsm_name", std::to_string(state.id)},
      {"speed_level", AsText(settings.at("speed_level"))},
      {"auto_recovery_switch", AsText(settings.at("auto_recovery"))},
      {"process_state", std::to_string(state.progress)},
  };
  return {.data = reply.dump()};
}

}  // namespace

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
  return Sport(
      title, kDocs,
      {Row(1007, "Euler", {Clamped("x", 0.75), Clamped("y", 0.75), Clamped("z", 0.6)},
           AskGoal{To<goal::Euler>}, "roll, pitch, yaw of the body, rad",
           "[sdk] go2/sport; [docs] ranges; that more is clamped is assumed"),
       Row(1008, "Move",
           {Clamped("x", limits.vx_min, limits.vx_max), Clamped("y", limits.vy),
            Clamped("z", limits.yaw_rate)},
           AskGoal{.goal = To<goal::Move>, .then = {limits.hold}},
           "velocity, m/s and rad/s, for 1 s; clients want no reply",
           "[sdk] go2/sport; [docs] ranges and hold; that more is clamped is assumed"),
       gesture(1009, "Sit", To<goal::Sit>, "sits"),
       gesture(1010, "RiseSit", To<goal::RiseSit>, "rises from sitting"),
       NotPlayed(1015, "SpeedLevel", kDocs, {Int("data", -1, 1)}),
       gesture(1016, "Hello", To<goal::Hello>, "waves"),
       gesture(1017, "Stretch", To<goal::Stretch>, "stretches"),
       NotPlayed(1020, "Content", kSdk),
       NotPlayed(1022, "Dance1", kSdk),
       NotPlayed(1023, "Dance2", kSdk),
       Row(1027, "SwitchJoystick", {Flag()}, Special{SwitchSticks},
           "whether the remote's sticks move the robot", kDocs),
       Row(1028, "Pose", {Flag()}, AskGoal{.goal = To<goal::Pose>, .not_now = kPostureUnfit},
           "poses, or ends the pose", kPosture),
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
       Row(2054, "AutoRecoverySet", {Flag()},
           AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
           "whether a fallen robot gets up by itself", kDocs),
       Row(2055, "AutoRecoveryGet", {}, GiveSetting{"auto_recovery", "data"},
           "what was set; false at the start (assumed)", kDocs),
       NotPlayed(2058, "SwitchAvoidMode", kSdk)},
      {{"auto_recovery", "false"}},
      "4201 when the present state does not allow it (assumed), 4205 for what is not "
      "played. Ids that firmware 1.1.6 removed (1011 to 1014, 1018, 1019, 1021, 1024 to "
      "1026) answer 3203.");
}

ServiceTable B2SportTable(std::string_view title, double hold) {
  constexpr std::string_view kSdk = "[sdk] b2/sport";
  return Sport(title, kSdk,
               {Row(1008, "Move", {Number("x"), Number("y"), Number("z")},
                    AskGoal{.goal = To<goal::Move>, .then = {hold}},
                    "velocity, m/s and rad/s; clients want no reply",
                    "[sdk] b2/sport; 0.5 s hold of B2-W: [sdk] b2w_sport_client example; 1 s of B2 "
                    "assumed; no range is published"),
                NotPlayed(1011, "SwitchGait", kSdk, {Int()}),
                Row(1013, "BodyHeight", {Number()}, AskGoal{To<goal::BodyHeight>},
                    "m over the own standing height; no range is published", kSdk),
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
                Row(1040, "AutoRecoverySet", {Flag()},
                    AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
                    "whether a fallen robot gets up by itself", kSdk),
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
                NotPlayed(1101, "VisionWalk", kSdk, {Flag()})},
               {{"auto_recovery", "false"}},
               "4201 when the present state does not allow it (assumed), 4205 for what is not "
               "played.");
}

ServiceTable A2SportTable() {
  constexpr std::string_view kA2 = "[sdk] a2/sport";
  return Sport(
      "sport of A2", kA2,
      {Row(1007, "Euler", {Number("x"), Number("y"), Number("z")}, AskGoal{To<goal::Euler>},
           "roll, pitch, yaw of the body, rad; no range is published", kA2),
       Row(1008, "Move", {Number("x"), Number("y"), Number("z")},
           AskGoal{.goal = To<goal::Move>, .then = {1.0}},
           "velocity, m/s and rad/s, for 1 s (assumed, as a Go2); no range is published", kA2),
       NotPlayed(1009, "BodyPosition", kA2, {Number("x"), Number("y"), Number("z"), Number("yaw")}),
       NotPlayed(1011, "SwitchGait", kA2, {Int()}),
       Row(1013, "BodyHeight", {Number()}, AskGoal{To<goal::BodyHeight>},
           "m over the own standing height; no range is published", kA2),
       Row(1015, "SpeedLevel", {Int()}, KeepSetting{"speed_level"}, "kept; read by GetState", kA2),
       NotPlayed(1016, "LeftSideGait", kA2, {Int()}),
       NotPlayed(1017, "RightSideGait", kA2, {Int()}), NotPlayed(1018, "HandStand", kA2, {Int()}),
       NotPlayed(1019, "BipedStand", kA2, {Int()}), NotPlayed(1020, "FrontFlip", kA2),
       NotPlayed(1021, "BackFlip", kA2),
       Row(1034, "GetState", {}, Special{&GiveA2State, true},
           "fsm_id, fsm_name, speed_level, auto_recovery_switch, process_state, each as "
           "text; "
           "the names of states are not published, fsm_name is the id",
           kA2),
       Row(1040, "SetAutoRecovery", {Flag()},
           AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
           "whether a fallen robot gets up by itself; read by GetState", kA2),
       NotPlayed(1035, "Trajectory", kA2,
                 {Path("path", 0), Int("feedback_mode"), Number("external_x"), Number("external_y"),
                  Number("external_yaw")}),
       NotPlayed(1111, "ResetEstimator", kA2)},
      {{"speed_level", "0"}, {"auto_recovery", "0"}},
      "4201 when the present state does not allow it (assumed), 4205 for what is not "
      "played. Clients wait for a reply to Move.");
}

}  // namespace understudy::services
