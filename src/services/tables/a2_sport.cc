// The motion service of A2.
#include <string>
#include <string_view>

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

// Another feedback than the robot's own estimate would need the pose that comes with it.
ServiceReply FollowA2Path(const ServiceCall& call) {
  if (call.parameter.at("feedback_mode") != 0) {
    *call.notice = "sport Trajectory: only feedback_mode 0, the own estimate, is played";
    return {.code = kNotPlayed, .refusal = CallRefusal::kNotSimulated};
  }
  return CodeOf(call.owner->Ask(PathOf(call.parameter, "path")));
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
