#include "wire/state_topics.h"

#include "robot/firmware.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

std::vector<std::string> GoTopics(const robot::RobotSpec& spec) {
  std::vector<std::string> topics = {kGoLowState.name, kGoLfLowState.name, kSportModeState.name,
                                     kLfSportModeState.name, kWirelessController.name};
  if (spec.error_list) topics.emplace_back(kErrorList.name);
  return topics;
}

std::vector<std::string> HgTopics(const robot::RobotSpec& spec) {
  std::vector<std::string> topics = {kHgLowState.name, kHgLfLowState.name, kOdomModeState.name,
                                     kLfOdomModeState.name};
  const auto add = [&topics](bool has, std::initializer_list<const char*> names) {
    if (has) topics.insert(topics.end(), names.begin(), names.end());
  };
  add(!spec.imu.secondary_site.empty(), {kSecondaryImu.name, kLfSecondaryImu.name});
  add(true, {kWirelessController.name, kLfBmsState.name, kLfMainBoardState.name});
  for (const robot::HandSpec& hand : spec.hands) {
    topics.push_back("rt/" + hand.topic + "/state");
    topics.push_back("rt/lf/" + hand.topic + "/state");
  }
  add(robot::TellsStateId(spec), {kHgSportModeState.name, kLfHgSportModeState.name});
  add(spec.arm_action_state, {kArmActionState.name});
  return topics;
}

}  // namespace

std::vector<std::string> StateTopics(const robot::RobotSpec& spec) {
  return spec.family == robot::WireFamily::kGo ? GoTopics(spec) : HgTopics(spec);
}

}  // namespace understudy::wire
