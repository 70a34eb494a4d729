#include <nlohmann/json.hpp>

#include "services/tables/fields.h"
#include "services/tables/tables.h"

namespace understudy::services {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

constexpr std::string_view kA2 = "[sdk] a2/sport";

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

ServiceTable A2SportTable() {
  return {
      .name = "sport",
      .title = "sport of A2",
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
               kA2},
              {1002,
               "BalanceStand",
               {},
               AskGoal{To<goal::BalanceStand>},
               "stands and balances",
               kA2},
              {1003, "StopMove", {}, AskGoal{To<goal::StopMove>}, "stops walking", kA2},
              {1004, "StandUp", {}, AskGoal{To<goal::StandUp>}, "stands with locked joints", kA2},
              {1005, "StandDown", {}, AskGoal{To<goal::StandDown>}, "lies down", kA2},
              {1006,
               "RecoveryStand",
               {},
               AskGoal{To<goal::RecoveryStand>},
               "stands up from anywhere",
               kA2},
              {1007,
               "Euler",
               {Number("x"), Number("y"), Number("z")},
               AskGoal{To<goal::Euler>},
               "roll, pitch, yaw of the body, rad; no range is published",
               kA2},
              {1008,
               "Move",
               {Number("x"), Number("y"), Number("z")},
               AskGoal{.goal = To<goal::Move>, .then = {1.0}},
               "velocity, m/s and rad/s, for 1 s (assumed, as a Go2); no range is published",
               kA2},
              NotPlayed(1009, "BodyPosition", kA2,
                        {Number("x"), Number("y"), Number("z"), Number("yaw")}),
              NotPlayed(1011, "SwitchGait", kA2, {Int()}),
              {1013,
               "BodyHeight",
               {Number()},
               AskGoal{To<goal::BodyHeight>},
               "m over the own standing height; no range is published",
               kA2},
              {1015,
               "SpeedLevel",
               {Int()},
               KeepSetting{"speed_level"},
               "kept; read by GetState",
               kA2},
              NotPlayed(1016, "LeftSideGait", kA2, {Int()}),
              NotPlayed(1017, "RightSideGait", kA2, {Int()}),
              NotPlayed(1018, "HandStand", kA2, {Int()}),
              NotPlayed(1019, "BipedStand", kA2, {Int()}),
              NotPlayed(1020, "FrontFlip", kA2),
              NotPlayed(1021, "BackFlip", kA2),
              {1034,
               "GetState",
               {},
               Special{&GiveA2State, true},
               "fsm_id, fsm_name, speed_level, auto_recovery_switch, process_state, each as text; "
               "the names of states are not published, fsm_name is the id",
               kA2},
              {1040,
               "SetAutoRecovery",
               {Flag()},
               AskGoal{.goal = To<goal::AutoRecovery>, .keep = "auto_recovery"},
               "whether a fallen robot gets up by itself; read by GetState",
               kA2},
              NotPlayed(1035, "Trajectory", kA2,
                        {Path("path", 0), Int("feedback_mode"), Number("external_x"),
                         Number("external_y"), Number("external_yaw")}),
              NotPlayed(1111, "ResetEstimator", kA2),
          },
      .settings = {{"speed_level", "0"}, {"auto_recovery", "0"}},
      .note =
          "4201 when the present state does not allow it (assumed), 4205 for what is not "
          "played. Clients wait for a reply to Move."};
}

}  // namespace understudy::services
