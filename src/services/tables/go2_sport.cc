// The motion service of Go2 and Go2-W, as it is and before firmware 1.1.6.
#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

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
using enum goal::GestureName;
using authority::ToIf;

constexpr std::int32_t kPostureUnfit = 4206;

// Of the row SwitchJoystick.
ServiceReply SwitchSticks(const ServiceCall& call) {
  call.owner->onboard().sticks = call.parameter.at("data").get<bool>();
  return {};
}

// The words that clients of api 1034 know; those of sitting and of the pose are assumed.
std::string_view StateWord(int id) {
  switch (id) {
    case 100:
    case 1015:
    case 1016:
    case 1017:
    case 2010:
      return "locomotion";
    case 1001:
      return "damping";
    case 1002:
      return "jointLock";
    case 1004:
      return "lieDown";
    case 1006:
      return "dance";
    case 1007:
      return "sit";
    case 1013:
      return "balanceStand";
    case 1091:
      return "pose";
    default:
      return "idle";
  }
}

// Each value is the text of an object of its own. 0 or 1 are what the clients' parsers have in
// common for flags: Python's eval() knows no `true`.
ServiceReply GiveGo2State(const ServiceCall& call) {
  constexpr int kGesture = 1006, kEconomic = 1017;
  const robot::MotionState& state = call.owner->state();
  const auto text = [](const nlohmann::json& value) {
    return nlohmann::json{{"data", value}}.dump();
  };
  const nlohmann::json reply = {
      {"state", text(StateWord(state.id))},
      {"bodyHeight", text(state.body_height)},
      {"footRaiseHeight", text(state.foot_raise)},
      {"speedLevel", text(call.settings->at("speed_level"))},
      {"gait", text(state.gait)},
      {"joystick", text(call.owner->onboard().sticks ? 1 : 0)},
      {"dance", text(state.id == kGesture ? 1 : 0)},
      {"continuousGait", text(state.keeps_stepping ? 1 : 0)},
      {"economicGait", text(state.id == kEconomic ? 1 : 0)},
  };
  return {.data = reply.dump()};
}

// Of api 1034.
constexpr std::string_view kState =
    "state, bodyHeight, footRaiseHeight, speedLevel, gait, joystick, dance, continuousGait, "
    "economicGait, always all of them; each is the text of an object with `data`";

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
       Row(1034, "GetState", {}, Special{&GiveGo2State, true}, kState,
           "[seen] listed of firmware 1.1.7; form and keys as below; that they stayed is assumed"),
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
      "4201 when the present state does not allow it (assumed), 4205 for what is not played. Ids "
      "that firmware 1.1.6 removed (1011 to 1014, 1018, 1019, 1021, 1024, 1025) answer 3203. "
      "Move's range is the vendor's; the part of it that is walked: docs/dev/walking.md.");
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
      Row(1034, "GetState", {}, Special{&GiveGo2State, true}, kState,
          "[docs] Go2 sports services: keys; [seen] form, three clients that parse it; gait and "
          "flags as numbers are assumed"),
      Row(1035, "EconomicGait", {Flag()}, AskGoal{ToIf<kEconomic>},
          "that gait: slower and lower steps; false: the default one", kOld)};
  std::ranges::move(rows, std::back_inserter(table.rows));
  table.settings.emplace_back("body_height", "0.0");
  table.settings.emplace_back("foot_raise_height", "0.0");
  table.note =
      "4201 when the present state does not allow it (assumed), 4205 for what is not played.";
  return table;
}

}  // namespace understudy::services
