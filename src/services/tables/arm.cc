#include <algorithm>
#include <array>
#include <utility>

#include <nlohmann/json.hpp>

#include "robot/arm_actions.h"
#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

constexpr std::int32_t kBusy = 7400;
constexpr std::int32_t kHolding = 7401;
constexpr std::int32_t kBadAction = 7402;
constexpr std::int32_t kBadState = 7404;

// The condition of the reply, as seen on a G1: the action has ended or is held.
bool IsSettled(const robot::MotionState& state) {
  return state.arm_action == 0 || state.arm_holding;
}
// The vendor's header: a held arm is released after 20 s at most, so no action takes longer.
constexpr std::chrono::seconds kLongestAction(20);

ServiceReply Answer(authority::MotionVerdict verdict, const robot::MotionState& before) {
  // [sdk] g1/arm: states that allow actions.
  constexpr std::array kStates = {200, 500, 501, 801, 802};
  switch (verdict) {
    case authority::MotionVerdict::kTaken:
    case authority::MotionVerdict::kIgnored:
      return {};
    case authority::MotionVerdict::kUnknown:
      return {.code = kBadAction};
    case authority::MotionVerdict::kNotNow:
      if (before.arm_holding) return {.code = kHolding};
      return {.code = std::ranges::find(kStates, before.id) == kStates.end() ? kBadState : kBusy};
    case authority::MotionVerdict::kUnable:
      break;
  }
  return {.code = kBadAction};
}

ServiceReply Execute(const ServiceCall& call) {
  const robot::MotionState before = call.owner->state();
  const int id = authority::goal::Whole(call.parameter.at("action_id").get<double>());
  ServiceReply reply = Answer(call.owner->Ask(authority::goal::ArmAction{id}), before);
  if (reply.code == kRpcOk) {
    reply.once = &IsSettled;
    reply.patience = kLongestAction;
  }
  return reply;
}

ServiceReply ExecuteByName(const ServiceCall&) {
  return {.code = kBadAction, .refusal = CallRefusal::kName};
}

ServiceReply Stop(const ServiceCall& call) {
  const robot::MotionState before = call.owner->state();
  return Answer(call.owner->Ask(authority::goal::StopArmAction{}), before);
}

// A list of the actions and one of those that were taught, of which there are none.
ServiceReply List(const ServiceCall&) {
  using nlohmann::json;
  json actions = json::array();
  for (const robot::ArmActionName& action : robot::kArmActions) {
    json& entry = actions.emplace_back(json{{"id", action.id}, {"name", action.name}});
    if (action.while_walking) entry["fsm"] = {500, 501};
  }
  return {.data = json::array({actions, json::array()}).dump()};
}

ApiRow Taught(std::int64_t id, std::string_view name) {
  return NotPlayed(id, name, "[seen] what the vendor's app sends a G1; the name is ours");
}

}  // namespace

ServiceTable G1ArmTable() {
  Field action = Int("action_id");
  action.also = "data";
  return {
      .name = "arm",
      .title = "arm",
      .api_version = "1.0.0.14",
      .parameter_code = kBadAction,
      .codes = {.not_now = kBadState, .unknown = kBadAction, .unable = kBadAction},
      .program = "g1_arm_example",
      .needs_motion = true,
      .rows =
          {
              Row(7106, "ExecuteAction", {action}, Special{&Execute},
                  "starts an action; answered when it has ended or is held; 7400 busy, 7401 held, "
                  "7402 unknown, 7404 not in this state",
                  "[sdk] g1/arm, [py]: two keys; [seen] answered after 4.19 s for a wave"),
              Row(7107, "GetActionList", {}, Special{&List, true},
                  "a list of ids and names, with fsm where an action is bound to states, and an "
                  "empty list of taught ones",
                  "[sdk] g1/arm; [seen] form and names on a G1 with firmware 1.4.7"),
              Row(7108, "ExecuteCustomAction", {Text("action_name")}, Special{&ExecuteByName},
                  "7402: no action has been taught", "[sdk] g1/arm"),
              Taught(7109, "RenameCustomAction"),
              Taught(7110, "RecordCustomAction"),
              Row(7113, "StopCustomAction", {}, Special{&Stop}, "lets the arms go", "[sdk] g1/arm"),
          },
      .note = "Part of the motion service: does not answer while that is off ([docs])."};
}

}  // namespace understudy::services
