#include "services/tables/sport.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <memory>

#include "services/tables/fields.h"

namespace understudy::services::sport {
namespace {

using authority::To;
namespace goal = authority::goal;
using namespace fields;  // NOLINT(google-build-using-namespace): the words a table is made of

// The numbers of the Go2's older firmware: 0 idle, 1 trot, 2 trot running, 3 and 4 up and down
// stairs. Idle is taken for the default gait (assumed).
authority::MotionGoal GaitByNumber(const goal::Numbers& numbers) {
  using enum goal::GaitName;
  constexpr std::array kByNumber{kFree, kTrot, kRun, kStairs, kStairs};
  const int number = goal::Whole(numbers[0]);
  const bool known = number >= 0 && static_cast<std::size_t>(number) < kByNumber.size();
  return goal::Gait{known ? kByNumber[static_cast<std::size_t>(number)] : kNone};
}

}  // namespace

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

std::string AsText(const nlohmann::json& value) {
  return value.is_string() ? value.get<std::string>() : value.dump();
}

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

}  // namespace understudy::services::sport
