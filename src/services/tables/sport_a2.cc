#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using enum authority::MotionAction;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

constexpr std::string_view kA2 = "[sdk] a2/sport";
constexpr std::string_view kAs2 = "[sdk] as2/sport";

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

// What A2 and AS2 have in common.
std::vector<ApiRow> CommonRows(std::string_view source) {
  return {
      {1001, "Damp", {}, AskGoal{kDamp}, "all joints damped, from every state", source},
      {1002, "BalanceStand", {}, AskGoal{kBalanceStand}, "stands and balances", source},
      {1003, "StopMove", {}, AskGoal{kStopMove}, "stops walking", source},
      {1004, "StandUp", {}, AskGoal{kStandUp}, "stands with locked joints", source},
      {1005, "StandDown", {}, AskGoal{kStandDown}, "lies down", source},
      {1006, "RecoveryStand", {}, AskGoal{kRecoveryStand}, "stands up from anywhere", source},
      {1007,
       "Euler",
       {Number("x"), Number("y"), Number("z")},
       AskGoal{kEuler},
       "roll, pitch, yaw of the body, rad; no range is published",
       source},
      {1008,
       "Move",
       {Number("x"), Number("y"), Number("z")},
       AskGoal{.action = kMove, .then = {1.0}},
       "velocity, m/s and rad/s, for 1 s (assumed, as a Go2); no range is published",
       source},
      NotPlayed(1009, "BodyPosition", source,
                {Number("x"), Number("y"), Number("z"), Number("yaw")}),
      NotPlayed(1011, "SwitchGait", source, {Int()}),
      {1013,
       "BodyHeight",
       {Number()},
       AskGoal{kBodyHeight},
       "m over the own standing height; no range is published",
       source},
      {1015, "SpeedLevel", {Int()}, KeepSetting{"speed_level"}, "kept; read by GetState", source},
      NotPlayed(1016, "LeftSideGait", source, {Int()}),
      NotPlayed(1017, "RightSideGait", source, {Int()}),
      NotPlayed(1018, "HandStand", source, {Int()}),
      NotPlayed(1019, "BipedStand", source, {Int()}),
      NotPlayed(1020, "FrontFlip", source),
      NotPlayed(1021, "BackFlip", source),
      {1034,
       "GetState",
       {},
       Special{&GiveA2State, true},
       "fsm_id, fsm_name, speed_level, auto_recovery_switch, process_state, each as text; the "
       "names of states are not published, fsm_name is the id",
       source},
      {1040,
       "SetAutoRecovery",
       {Flag()},
       AskGoal{.action = kAutoRecovery, .keep = "auto_recovery"},
       "whether a fallen robot gets up by itself; read by GetState",
       source},
  };
}

ServiceTable Table(std::string_view title, std::vector<ApiRow> rows) {
  return {.name = "sport",
          .title = title,
          .api_version = "1.0.0.1",
          .parameter_code = kRpcApiParameter,
          .codes = {.not_now = 4201, .unknown = kRpcApiParameter, .unable = 4205},
          .needs_motion = true,
          .rows = std::move(rows),
          .settings = {{"speed_level", "0"}, {"auto_recovery", "0"}, {"joystick", "true"}},
          .note =
              "4201 when the present state does not allow it (assumed), 4205 for what is not "
              "played. Clients wait for a reply to Move."};
}

}  // namespace

ServiceTable A2SportTable() {
  std::vector<ApiRow> rows = CommonRows(kA2);
  rows.push_back(NotPlayed(1035, "Trajectory", kA2,
                           {Path("path", 0), Int("feedback_mode"), Number("external_x"),
                            Number("external_y"), Number("external_yaw")}));
  rows.push_back(NotPlayed(1111, "ResetEstimator", kA2));
  return Table("sport of A2", std::move(rows));
}

ServiceTable As2SportTable() {
  std::vector<ApiRow> rows = CommonRows(kAs2);
  for (const auto& [id, name] :
       std::initializer_list<std::pair<std::int64_t, std::string_view>>{{1022, "Greeting"},
                                                                        {1023, "Heart"},
                                                                        {1024, "Content"},
                                                                        {1025, "Dance1"},
                                                                        {1026, "Dance2"},
                                                                        {1027, "HandShake"},
                                                                        {1030, "FrontJump"},
                                                                        {1031, "PushUp"},
                                                                        {1032, "UpJump"}}) {
    rows.push_back(NotPlayed(id, name, kAs2));
  }
  rows.push_back({1028, "Stretch", {}, AskGoal{kStretch}, "stretches", kAs2});
  rows.push_back({.id = 1029,
                  .name = "Sit",
                  .fields = {Flag()},
                  .effect = Special{[](const ServiceCall& call) {
                    const bool sit = call.parameter.at("data").get<bool>();
                    const auto verdict = call.owner->Ask({.action = sit ? kSit : kRiseSit});
                    if (verdict == authority::MotionVerdict::kTaken) return ServiceReply{};
                    return ServiceReply{
                        .code = verdict == authority::MotionVerdict::kUnable ? 4205 : 4201};
                  }},
                  .does = "sits, or rises",
                  .source = kAs2});
  rows.push_back({1041,
                  "SwitchJoystick",
                  {Flag()},
                  KeepSetting{"joystick"},
                  "kept; whether the remote's sticks move the robot",
                  kAs2});
  return Table("sport of AS2", std::move(rows));
}

}  // namespace understudy::services
