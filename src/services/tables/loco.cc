#include <array>
#include <iterator>
#include <string>

#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

// The services of the humanoids. The ids of G1, H2, R1 and H1 differ, the functions are the same.
struct Loco {
  std::string_view source;
  std::int64_t get = 7000, set = 7100;
  std::int32_t state_code = 7301, task_code = 7303;
};

// [seen] on G1s: heights, balance mode and phase come with 7301 and a plausible body in the states
// that walk (500 or 501) or run (801 or 802).
const std::vector<int>& WalkingIds() {
  static const std::vector<int> kIds = {500, 501, 801, 802};
  return kIds;
}

ApiRow GetId(const Loco& l) {
  return Row(l.get + 1, "GetFsmId", {}, GiveState{StateWord::kId, "data"}, "id of the state",
             l.source);
}
ApiRow GetMode(const Loco& l) {
  return Row(l.get + 2, "GetFsmMode", {}, GiveState{StateWord::kMode, "data"},
             "0 static, 1 moving, 2 feet without load", l.source);
}
ApiRow SetId(const Loco& l, std::string_view source) {
  return Row(l.set + 1, "SetFsmId", {Int()},
             AskGoal{.goal = To<goal::SetFsm>, .not_now = kRpcOk, .unknown = kRpcOk},
             "requests a state; an unknown or unreachable one is answered 0 and ignored", source);
}
ApiRow SetVelocity(const Loco& l) {
  return Row(l.set + 5, "SetVelocity", {Numbers("velocity", 3), Number("duration", 0)},
             AskGoal{.goal = To<goal::Move>, .not_now = kRpcOk},
             "vx, vy m/s, yaw rate rad/s, duration s; ignored if the robot cannot walk",
             "[sdk] loco; [seen] 0 and no walking; no range is published");
}
ApiRow SetSpeedMode(const Loco& l) {
  return Row(l.set + 7, "SetSpeedMode", {Int("data", 0, 3)}, KeepSetting{"speed_mode"},
             "stored; highest speed of running: 1.0, 2.0, 2.7, 3.0 m/s", "[sdk] loco; [docs] G1");
}

ApiRow Getter(const Loco& l, std::int64_t id, std::string_view name, std::string_view setting,
              bool refused_walking) {
  GiveSetting effect{.name = setting, .key = "data"};
  if (refused_walking) {
    effect.refused_in = WalkingIds();
    effect.refused = l.state_code;
  }
  return {
      .id = l.get + id,
      .name = name,
      .effect = std::move(effect),
      .does = refused_walking ? "what was set; with 7301 while walking or running" : "what was set",
      .source = refused_walking ? "[sdk] loco; [seen] 7301 with a plausible body at 500, 501, 802"
                                : l.source};
}

// Heights, balance mode and phase, the same for G1, H2 and H1.
std::vector<ApiRow> CommonRows(const Loco& l, bool refused_walking) {
  return {
      GetId(l),
      GetMode(l),
      Getter(l, 3, "GetBalanceMode", "balance_mode", refused_walking),
      Getter(l, 4, "GetSwingHeight", "swing_height", refused_walking),
      Getter(l, 5, "GetStandHeight", "stand_height", refused_walking),
      Getter(l, 6, "GetPhase", "phase", refused_walking),
      Row(l.set + 2, "SetBalanceMode", {Int("data", 0, 1)},
          AskGoal{.goal = To<goal::SetBalanceMode>, .keep = "balance_mode", .not_now = kRpcOk},
          "0 steps only when needed, 1 keeps stepping",
          "[sdk] loco; [docs] G1; that more is refused is assumed"),
      Row(l.set + 3, "SetSwingHeight", {Number()}, KeepSetting{"swing_height"},
          "stored; no range is published", l.source),
      Row(l.set + 4, "SetStandHeight", {Clamped("data", 0, 1)},
          AskGoal{.goal = To<goal::SetStandHeight>, .keep = "stand_height", .not_now = kRpcOk},
          "0 lowest to 1 highest; HighStand sends 4294967295",
          "[sdk] loco: saturates; that 1 is the highest is assumed"),
      SetVelocity(l),
  };
}

std::vector<std::pair<std::string_view, std::string_view>> CommonSettings() {
  // Assumed: no start values are published.
  return {{"balance_mode", "0"},
          {"swing_height", "0.0"},
          {"stand_height", "1.0"},
          {"phase", "[0.0,0.0]"},
          {"speed_mode", "0"}};
}

// The arm actions for the tasks of the loco services (assumed): wave, wave and turn, both halves of
// a handshake.
ServiceReply AskArm(const ServiceCall& call, std::int64_t arm_action, std::int32_t state_code) {
  authority::MotionGoal wanted = goal::ArmAction{static_cast<int>(arm_action)};
  if (arm_action == 99) wanted = goal::StopArmAction{};
  const authority::MotionVerdict verdict = call.owner->Ask(wanted);
  if (verdict == authority::MotionVerdict::kTaken || verdict == authority::MotionVerdict::kNotNow)
    return {};
  return {.code = state_code};
}

ServiceReply SetG1Task(const ServiceCall& call) {
  constexpr std::array kActions = {25, 1, 27, 99};
  const auto task = call.parameter.at("data").get<std::int64_t>();
  if (task < 0 || task >= std::ssize(kActions)) return {.code = 7303};
  return AskArm(call, kActions[static_cast<std::size_t>(task)], 7301);
}

ServiceReply SetH1Task(const ServiceCall& call) {
  constexpr std::array kActions = {25, 27, 99};
  const auto task = call.parameter.at("data").get<std::int64_t>();
  if (task < 0 || task >= std::ssize(kActions)) return {.code = 8304};
  return AskArm(call, kActions[static_cast<std::size_t>(task)], 8301);
}

ApiRow SetTask(const Loco& l, std::int64_t id, ServiceReply (*answer)(const ServiceCall&),
               std::string_view does) {
  return {.id = id,
          .name = "SetArmTask",
          .fields = {Int()},
          .effect = Special{answer},
          .does = does,
          .source = l.task_code == 7303
                        ? "[sdk] loco: tasks, 7303; that they are the arm service's is assumed"
                        : "[sdk] loco: tasks, 8304; that they are the arm service's is assumed"};
}

ServiceReply LeaveToUser(const ServiceCall& call) {
  call.owner->onboard().user_control = true;
  return {};
}

// Modes: 0 the last state, 1 damping, 2 walking.
ServiceReply TakeBack(const ServiceCall& call) {
  constexpr int kPassive = 1, kWalkRun = 2;
  const int mode = call.parameter.at("data").get<int>();
  call.owner->onboard().user_control = false;
  if (mode == kPassive) call.owner->Ask(goal::Damp{});
  if (mode == kWalkRun &&
      call.owner->Ask(goal::BalanceStand{}) == authority::MotionVerdict::kUnable) {
    return {.code = 7301};
  }
  return {};
}

ServiceReply GiveH2Ids(const ServiceCall&) {
  constexpr std::array kIds = {0, 1, 2, 3, 4, 5, 100, 502, 503, 601, 701, 703};
  constexpr std::array kNames = {"Invalid",     "Passive",       "Protection",  "Sit",
                                 "FixStand",    "HybridPassive", "BeyondMimic", "HumanMimic",
                                 "HumanMimic2", "HybridWalk",    "WalkNew",     "PhaseWalk"};
  return {.data = nlohmann::json{{"ids", kIds}, {"names", kNames}}.dump()};
}

// An R1 has codes of its own: 1001 it is in that state, also while rt/arm_sdk keeps it in another
// (816) for that one, 1003 no such state.
ServiceReply SetR1Id(const ServiceCall& call) {
  constexpr std::int32_t kAlready = 1001, kNoState = 1003;
  constexpr int kWalk = 811, kWalkWithArms = 816;
  const int id = goal::Whole(call.parameter.at("data").get<double>());
  const int now = call.owner->state().id;
  if (id == now || (id == kWalk && now == kWalkWithArms)) return {.code = kAlready};
  switch (call.owner->Ask(goal::SetFsm{id})) {
    case authority::MotionVerdict::kTaken:
    case authority::MotionVerdict::kIgnored:
    case authority::MotionVerdict::kNotNow:
      return {};
    case authority::MotionVerdict::kUnknown:
      return {.code = kNoState};
    case authority::MotionVerdict::kUnable:
      break;
  }
  return {.code = 7301};
}

// Two R1s answered so in every state; one of them walked all the same.
ServiceReply MoveR1(const ServiceCall& call) {
  const auto velocity = call.parameter.at("velocity").get<std::array<double, 3>>();
  const auto duration = call.parameter.at("duration").get<double>();
  call.owner->Ask(goal::Move{velocity[0], velocity[1], velocity[2], duration});
  return {.code = 127};
}

// The vendor's C++ client parses the body of a failure too and would terminate on an empty one.
ServiceReply GiveNoOdometry(const ServiceCall&) {
  return {.code = 8303, .data = R"({"x":0.0,"y":0.0,"z":0.0})"};
}

constexpr std::string_view kNote =
    "Codes as seen on robots: an unknown or unreachable state is answered 0 and nothing happens, "
    "though the header has 7302; GetFsmId returns the actual state. 7301 for anything not "
    "simulated.";

ServiceTable HumanoidSport(std::string_view title, std::vector<ApiRow> rows,
                           std::vector<std::pair<std::string_view, std::string_view>> settings) {
  return {.name = "sport",
          .title = title,
          .api_version = "1.0.0.0",
          .codes = {.not_now = kRpcOk, .unknown = 7302, .unable = 7301},
          .needs_motion = true,
          .rows = std::move(rows),
          .settings = std::move(settings),
          .note = kNote};
}

}  // namespace

ServiceTable G1SportTable() {
  const Loco l{.source = "[sdk] g1/loco"};
  ServiceTable table =
      HumanoidSport("sport of G1, since firmware 1.4", CommonRows(l, true), CommonSettings());
  table.rows.push_back(SetId(l, "[sdk] g1/loco; [seen] 99999 answered 0, impossible ones ignored"));
  table.rows.push_back(
      SetTask(l, 7106, &SetG1Task, "0 wave, 1 wave and turn, 2 handshake, 3 end of it"));
  table.rows.push_back(SetSpeedMode(l));
  table.rows.push_back({.id = 7110,
                        .name = "SwitchToUserCtrl",
                        .fields = {Optional(Bool())},
                        .effect = Special{&LeaveToUser},
                        .does = "lets rt/user_lowcmd command the motors",
                        .source = "[sdk] g1/loco"});
  table.rows.push_back({.id = 7111,
                        .name = "SwitchToInternalCtrl",
                        .fields = {Int("data", 0, 2)},
                        .effect = Special{&TakeBack},
                        .does = "takes the motors back: 0 last state, 1 damping, 2 walking",
                        .source = "[sdk] g1/loco"});
  table.rows.push_back({.id = 7100,
                        .name = "EndAppAction",
                        .fields = {Int("fsm_id"), Int("api_id"), Bool("motion_paused")},
                        .effect = NoController{},
                        .does = "ends an action of the vendor's app (state 550); not simulated",
                        .source = "[seen] what the app sends; its name is ours"});
  return table;
}

// The calls of unitree_sdk2's g1/loco of 2024, on the topic that its clients ask.
ServiceTable G1LocoTable() {
  const Loco l{.source = "[sdk] g1/loco as of 2024"};
  ServiceTable table =
      HumanoidSport("loco of G1, before firmware 1.4", CommonRows(l, false), CommonSettings());
  table.name = "loco";
  table.rows.push_back(SetId(l, "[sdk] g1/loco; codes as of newer firmware, assumed"));
  return table;
}

ServiceTable H2SportTable() {
  const Loco l{.source = "[sdk] h2/loco"};
  ServiceTable table = HumanoidSport("sport of H2", CommonRows(l, false), CommonSettings());
  table.settings.emplace_back("arm_sdk", "false");
  table.rows.push_back(
      Row(7007, "GetArmSdkStatus", {}, GiveSetting{"arm_sdk", "data"}, "what was set", l.source));
  table.rows.push_back(Row(7008, "GetAvailableFsmIds", {}, Special{&GiveH2Ids, true},
                           "ids and names of an H2; not all are simulated",
                           "[sdk] h2/loco; [seen] the list of an H2"));
  table.rows.push_back(SetId(l, "[sdk] h2/loco; codes as a G1's, assumed"));
  table.rows.push_back(
      SetTask(l, 7106, &SetG1Task, "0 wave, 1 wave and turn, 2 handshake, 3 end of it"));
  table.rows.push_back(SetSpeedMode(l));
  table.rows.push_back(NotPlayed(7108, "SetPunch", l.source, {Numbers("data", 0)}));
  table.rows.push_back(
      Row(7109, "SetArmSdkStatus", {Flag()}, KeepSetting{"arm_sdk"}, "stored", l.source));
  return table;
}

ServiceTable R1SportTable() {
  const Loco l{.source = "[sdk] r1/loco"};
  ServiceTable table = HumanoidSport(
      "sport of R1",
      {GetId(l),
       Row(7101, "SetFsmId", {Int()}, Special{&SetR1Id},
           "requests a state: 0 taken, also where it cannot be reached from the present one; 1001 "
           "already in it; 1003 no such state",
           "[sdk] r1/loco; [seen] codes of two R1s"),
       {.id = 7105,
        .name = "SetVelocity",
        .fields = {Numbers("velocity", 3), Number("duration", 0)},
        .effect = Special{&MoveR1},
        .does = "walks; 127 in every state",
        .source = "[sdk] r1/loco; [seen] 127 on two R1s, one of which walked all the same; 3202",
        .parameter_code = kRpcServerInternal},
       SetTask(l, 7106, &SetG1Task, "0 wave, 1 wave and turn, 2 handshake, 3 end of it")},
      {});
  table.note =
      "Its codes are its own, seen on two robots with ai_sport 1.0.2.154, which have 7001, 7101, "
      "7105 and 7106 only: GetFsmMode (7002) and SetSpeedMode (7107) of the header answer 3203.";
  return table;
}

ServiceTable H1LocoTable() {
  const Loco l{
      .source = "[sdk] h1/loco", .get = 8000, .set = 8100, .state_code = 8301, .task_code = 8304};
  ServiceTable table{.name = "loco",
                     .title = "loco of H1",
                     .api_version = "2.0.0.0",
                     .codes = {.not_now = kRpcOk, .unknown = 8302, .unable = 8301},
                     .needs_motion = true,
                     .rows = CommonRows(l, false),
                     .settings = CommonSettings(),
                     .note =
                         "An unreachable state is answered 0 and nothing happens, as on an H1-2, "
                         "though the header has 8302; 8301 for anything not simulated."};
  table.settings.emplace_back("odometry", "false");
  table.rows.push_back(SetId(l, "[sdk] h1/loco; [seen] H1-2: 0 without effect"));
  table.rows.push_back(
      Row(8106, "SetPhase", {Numbers("data", 2)}, KeepSetting{"phase"}, "stored", l.source));
  table.rows.push_back(SetTask(l, 8107, &SetH1Task, "0 wave, 1 handshake, 2 end of it"));
  table.rows.push_back(NotPlayed(8201, "EnableOdom", l.source));
  table.rows.push_back(NotPlayed(8202, "DisableOdom", l.source));
  for (ApiRow& row : table.rows) {
    if (row.id == 8201 || row.id == 8202) row.unable_code = 8303;
  }
  table.rows.push_back(Row(8203, "GetOdom", {}, Special{&GiveNoOdometry, true},
                           "8303 and zeros: the service's odometry is not simulated",
                           "[sdk] h1/loco; [seen] H1-2: zeros"));
  table.rows.push_back(NotPlayed(8204, "SetTargetPosition", l.source,
                                 {Number("x"), Number("y"), Number("yaw"), Bool("relative")}));
  return table;
}

}  // namespace understudy::services
