// The motion services of quadrupeds: sport of Go2, B2 and A2 with their kin.
#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

using enum goal::GaitName;
using enum goal::GestureName;
using authority::ToIf;

constexpr std::int32_t kActionTimeout = 4201;
constexpr std::int32_t kNotPlayed = 4205;
constexpr std::int32_t kPostureUnfit = 4206;

// Of the row SwitchJoystick.
ServiceReply SwitchSticks(const ServiceCall& call) {
  call.owner->SetSticks(call.parameter.at("data").get<bool>());
  return {};
}

// What became of a goal, in the codes of all of them.
ServiceReply CodeOf(authority::MotionVerdict verdict) {
  switch (verdict) {
    case authority::MotionVerdict::kTaken:
    case authority::MotionVerdict::kIgnored:
      return {};
    case authority::MotionVerdict::kNotNow:
      return {.code = kActionTimeout};
    case authority::MotionVerdict::kUnknown:
      return {.code = kRpcApiParameter};
    case authority::MotionVerdict::kUnable:
      break;
  }
  return {.code = kNotPlayed};
}

// That of the array of points under `key`.
goal::FollowPath PathOf(const nlohmann::json& parameter, std::string_view key) {
  auto points = std::make_shared<std::vector<goal::PathPoint>>();
  for (const nlohmann::json& point : parameter.at(std::string(key))) {
    points->push_back({.t = point.at("t_from_start").get<double>(),
                       .x = point.at("x").get<double>(),
                       .y = point.at("y").get<double>(),
                       .yaw = point.at("yaw").get<double>()});
  }
  return {std::move(points)};
}

ServiceReply FollowB2Path(const ServiceCall& call) {
  return CodeOf(call.owner->Ask(PathOf(call.parameter, "")));
}

// Another feedback than the robot's own estimate would need the pose that comes with it.
ServiceReply FollowA2Path(const ServiceCall& call) {
  if (call.parameter.at("feedback_mode") != 0) {
    *call.notice = "sport Trajectory: only feedback_mode 0, the own estimate, is played";
    return {.code = kNotPlayed, .refusal = CallRefusal::kNotSimulated};
  }
  return CodeOf(call.owner->Ask(PathOf(call.parameter, "path")));
}

// Clients disagree: one sends three angles, the other a flag. A flag levels the body, angles
// follow.
ServiceReply FreeEuler(const ServiceCall& call) {
  const auto angle = [&](const char* key) { return call.parameter.value(key, 0.0); };
  return CodeOf(call.owner->Ask(goal::Euler{angle("x"), angle("y"), angle("z")}));
}

// The numbers of the Go2's older firmware: 0 idle, 1 trot, 2 trot running, 3 and 4 up and down
// stairs. Idle is taken for the default gait (assumed).
authority::MotionGoal GaitByNumber(const goal::Numbers& numbers) {
  using enum goal::GaitName;
  constexpr std::array kByNumber{kFree, kTrot, kRun, kStairs, kStairs};
  const int number = goal::Whole(numbers[0]);
  const bool known = number >= 0 && static_cast<std::size_t>(number) < kByNumber.size();
  return goal::Gait{known ? kByNumber[static_cast<std::size_t>(number)] : kNone};
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
      .codes = {.not_now = kActionTimeout, .unknown = kRpcApiParameter, .unable = kNotPlayed},
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

ApiRow SpeedLevel(Field level, std::string_view source) {
  return Row(
      1015, "SpeedLevel", {level}, AskGoal{.goal = To<goal::SpeedLevel>, .keep = "speed_level"},
      "-1: Move's range and the sticks at half; 1: the sticks at one and a half (assumed)", source);
}

ApiRow SwitchGait(std::string_view source) {
  return Row(1011, "SwitchGait", {Int()}, AskGoal{&GaitByNumber},
             "0 the default gait, 1 trot, 2 running, 3 and 4 stairs, as the Go2's older firmware "
             "(assumed)",
             source);
}

std::string AsText(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

// The words of the vendor's app for the states that are played.
std::string_view StateWord(int id) {
  switch (id) {
    case 100:
      return "freeWalk";
    case 1001:
      return "damping";
    case 1002:
      return "jointLock";
    case 1004:
      return "lieDown";
    case 1006:
      return "hello";
    case 1007:
      return "sit";
    case 1013:
      return "balanceStand";
    case 1015:
      return "walk";
    case 1016:
      return "run";
    case 1017:
      return "batteryLife";
    case 1091:
      return "pose";
    case 2010:
      return "stair";
    default:
      return "idle";
  }
}

// Values as texts: the vendor's client reads no others.
ServiceReply GiveGo2State(const ServiceCall& call) {
  constexpr int kEconomic = 1017;
  const robot::MotionState& state = call.owner->state();
  const nlohmann::json reply = {
      {"state", std::string(StateWord(state.id))},
      {"bodyHeight", nlohmann::json(state.body_height).dump()},
      {"speedLevel", AsText(call.settings->at("speed_level"))},
      {"gait", std::to_string(state.gait)},
      {"continuousGait", state.keeps_stepping ? "true" : "false"},
      {"economicGait", state.id == kEconomic ? "true" : "false"},
  };
  return {.data = reply.dump()};
}

// The vendor's client reads every value as a text and asks for the keys below.
ServiceReply GiveA2State(const ServiceCall& call) {
  const robot::MotionState& state = call.owner->state();
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
  constexpr std::string_view kApp = "[seen] the vendor's app, firmware 1.1.11";
  const auto gesture = [&](std::int64_t id, std::string_view name, authority::GoalMaker goal,
                           std::string_view does) {
    return ApiRow{.id = id,
                  .name = name,
                  .effect = AskGoal{.goal = goal, .not_now = kPostureUnfit},
                  .does = does,
                  .source = kPosture};
  };
  constexpr std::string_view kGait =
      "[sdk] go2/sport; [docs] Go2 motion services V2.0; [seen] FreeWalk 0 after StandUp";
  const auto gait = [&](std::int64_t id, std::string_view name, authority::GoalMaker goal,
                        std::string_view does) {
    return Row(id, name, {}, AskGoal{goal}, does, kGait);
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
       SpeedLevel(Int("data", -1, 1), kDocs),
       gesture(1016, "Hello", To<kHello>, "waves"),
       gesture(1017, "Stretch", To<kStretch>, "stretches"),
       gesture(1020, "Content", To<kContent>, "wags"),
       gesture(1022, "Dance1", To<kDance1>, "dances for 18 s"),
       gesture(1023, "Dance2", To<kDance2>, "dances for 8 s"),
       Row(1026, "GetSpeedLevel", {}, GiveSetting{"speed_level", "data"}, "what was set",
           "[seen] 0 on a Go2 with mcf; the reply's key is assumed"),
       Row(1027, "SwitchJoystick", {Flag()}, Special{SwitchSticks},
           "whether the remote's sticks move the robot", kDocs),
       Row(1028, "Pose", {Flag()}, AskGoal{.goal = To<goal::Pose>, .not_now = kPostureUnfit},
           "poses, or ends the pose", kPosture),
       gesture(1029, "Scrape", To<kScrape>, "bows and scrapes with a paw, on three legs"),
       NotPlayed(1030, "FrontFlip", kSdk),
       NotPlayed(1031, "FrontJump", kSdk),
       NotPlayed(1032, "FrontPounce", kSdk),
       gesture(1036, "Heart", To<kHeart>, "draws a heart with a paw, on three legs"),
       Row(1034, "GetState", {}, Special{&GiveGo2State, true},
           "state, bodyHeight, speedLevel, gait, continuousGait, economicGait, each as text",
           "[seen] listed of firmware 1.1.7; its words are the app's, its form is assumed"),
       {.id = 1049,
        .name = "WalkStair",
        .fields = {Flag()},
        .effect = AskGoal{ToIf<kStairs>},
        .does = "the gait for stairs: highest steps; false: the default one",
        .source = "[seen] the vendor's app, firmware 1.1.11"},
       gait(1061, "StaticWalk", To<kStatic>, "that gait: one foot at a time"),
       gait(1062, "TrotRun", To<kRun>, "that gait: quicker steps, but no flight"),
       gait(1063, "EconomicGait", To<kEconomic>, "that gait: slower and lower steps"),
       NotPlayed(2041, "LeftFlip", kSdk),
       NotPlayed(2043, "BackFlip", kSdk),
       NotPlayed(2044, "HandStand", kSdk, {Flag()}),
       gait(2045, "FreeWalk", To<kFree>, "the default gait; frees the joints after StandUp"),
       NotPlayed(2046, "FreeBound", kSdk, {Flag()}),
       NotPlayed(2047, "FreeJump", kSdk, {Flag()}),
       NotPlayed(2048, "FreeAvoid", kSdk, {Flag()}),
       {.id = 2049,
        .name = "ClassicWalk",
        .fields = {Flag()},
        .effect = AskGoal{ToIf<kClassic>},
        .does = "that gait, higher steps; false: the default one",
        .source = kGait},
       NotPlayed(2050, "WalkUpright", kSdk, {Flag()}),
       NotPlayed(2051, "CrossStep", kSdk, {Flag()}),
       Row(2054, "AutoRecoverySet", {Flag()},
           AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
           "whether a fallen robot gets up by itself", kDocs),
       Row(2055, "AutoRecoveryGet", {}, GiveSetting{"auto_recovery", "data"},
           "what was set; false at the start (assumed)", kDocs),
       NotPlayed(2056, "LeadFollow", kApp, {Flag()}),
       NotPlayed(2058, "SwitchAvoidMode", kSdk),
       NotPlayed(2059, "RageMode", kApp, {Flag()})},
      {{"auto_recovery", "false"}, {"speed_level", "0"}},
      "4201 when the present state does not allow it (assumed), 4205 for what is not "
      "played. Ids that firmware 1.1.6 removed (1011 to 1014, 1018, 1019, 1021, 1024, 1025) "
      "answer 3203. Move's range is the vendor's; the part of it that is walked: docs/walking.md.");
}

ServiceTable OldGo2SportTable(const MoveLimits& limits) {
  constexpr std::string_view kOld = "[sdk] go2/sport as of 2024";
  constexpr std::string_view kRange = "[sdk] go2/sport as of 2024; [docs] Go2 sports services";
  constexpr std::int64_t kLast = 1036, kGetState = 1034;
  ServiceTable table = Go2SportTable("sport of Go2, before firmware 1.1.6", limits);
  std::erase_if(table.rows,
                [](const ApiRow& row) { return row.id > kLast || row.id == kGetState; });
  std::vector<ApiRow> rows{
      SwitchGait(kOld),
      NotPlayed(1012, "Trigger", kOld),
      Row(1013, "BodyHeight", {Clamped("data", -0.18, 0.03)},
          AskGoal{.goal = To<goal::BodyHeight>, .keep = "body_height"}, "m over 0.33", kRange),
      Row(1014, "FootRaiseHeight", {Clamped("data", -0.06, 0.03)},
          AskGoal{.goal = To<goal::FootRaise>, .keep = "foot_raise_height"},
          "m over what the gait lifts feet by", kRange),
      {.id = 1018,
       .name = "TrajectoryFollow",
       .fields = {Path("", 30)},
       .effect = Special{&FollowB2Path},
       .does = "follows the points, each to be passed at its time from now; clients want no reply",
       .source = "[sdk] go2/sport as of 2024: 30 points, 4101 for another number",
       .parameter_code = 4101},
      Row(1019, "ContinuousGait", {Flag()}, AskGoal{To<goal::KeepStepping>},
          "steps on the spot where it would stand", kOld),
      NotPlayed(1021, "Wallow", kOld),
      Row(1024, "GetBodyHeight", {}, GiveSetting{"body_height", "data"}, "what was set", kOld),
      Row(1025, "GetFootRaiseHeight", {}, GiveSetting{"foot_raise_height", "data"}, "what was set",
          kOld),
      {.id = 1033,
       .name = "WiggleHips",
       .effect = AskGoal{.goal = To<kWiggleHips>, .not_now = kPostureUnfit},
       .does = "swings its rump from side to side",
       .source = kOld},
      Row(1034, "GetState", {}, Special{&GiveGo2State, true},
          "state, bodyHeight, speedLevel, gait, continuousGait, economicGait, each as text",
          "[sdk] go2/sport as of 2024; its form is assumed"),
      Row(1035, "EconomicGait", {Flag()}, AskGoal{ToIf<kEconomic>},
          "that gait: slower and lower steps; false: the default one", kOld)};
  std::ranges::move(rows, std::back_inserter(table.rows));
  table.settings.emplace_back("body_height", "0.0");
  table.settings.emplace_back("foot_raise_height", "0.0");
  table.note =
      "4201 when the present state does not allow it (assumed), 4205 for what is not played.";
  return table;
}

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

ServiceTable A2SportTable() {
  constexpr std::string_view kA2 = "[sdk] a2/sport";
  return Sport(
      "sport of A2", kA2,
      {Row(1007, "Euler", {Number("x"), Number("y"), Number("z")}, AskGoal{To<goal::Euler>},
           "roll, pitch, yaw of the body, rad; no range is published", kA2),
       Row(1008, "Move", {Number("x"), Number("y"), Number("z")},
           AskGoal{.goal = To<goal::Move>, .then = {1.0}},
           "velocity, m/s and rad/s, for 1 s (assumed, as a Go2); no range is published", kA2),
       Row(1009, "BodyPosition", {Number("x"), Number("y"), Number("z"), Number("yaw")},
           AskGoal{To<goal::BodyPosition>},
           "m ahead, to the left, over the own standing height, and rad, of the body over its "
           "feet; no range is published",
           kA2),
       SwitchGait(kA2),
       Row(1013, "BodyHeight", {Number()}, AskGoal{To<goal::BodyHeight>},
           "m over the own standing height; no range is published", kA2),
       SpeedLevel(Int(), "[sdk] a2/sport: read by GetState; levels as a Go2's, assumed"),
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
       Row(1035, "Trajectory",
           {Path("path", 0), Int("feedback_mode"), Number("external_x"), Number("external_y"),
            Number("external_yaw")},
           Special{&FollowA2Path},
           "follows the points, each to be passed at its time from now; places are those of "
           "rt/sportmodestate; another feedback_mode than 0 (assumed: the own estimate) is 4205",
           kA2),
       Row(1111, "ResetEstimator", {}, AskGoal{To<goal::ResetEstimator>},
           "the robot's place is 0 again", kA2)},
      {{"speed_level", "0"}, {"auto_recovery", "0"}},
      "4201 when the present state does not allow it (assumed), 4205 for what is not "
      "played. Clients wait for a reply to Move.");
}

}  // namespace understudy::services
