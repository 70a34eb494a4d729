#include "wire/state_topics.h"

#include "robot/firmware.h"
#include "wire/topics.h"

namespace understudy::wire {
namespace {

template <typename Msg>
StateTopic Of(const bus::Topic<Msg>& topic) {
  return {topic.name, topic.descriptor};
}

std::vector<StateTopic> GoTopics(const robot::RobotSpec& spec) {
  std::vector<StateTopic> topics = {Of(kGoLowState), Of(kGoLfLowState), Of(kSportModeState),
                                    Of(kLfSportModeState), Of(kWirelessController)};
  if (spec.error_list) topics.push_back(Of(kErrorList));
  return topics;
}

std::vector<StateTopic> HgTopics(const robot::RobotSpec& spec) {
  std::vector<StateTopic> topics = {Of(kHgLowState), Of(kHgLfLowState), Of(kOdomModeState),
                                    Of(kLfOdomModeState)};
  const auto add = [&topics](bool has, std::initializer_list<StateTopic> more) {
    if (has) topics.insert(topics.end(), more);
  };
  add(!spec.imu.secondary_site.empty(), {Of(kSecondaryImu), Of(kLfSecondaryImu)});
  add(true, {Of(kWirelessController), Of(kLfBmsState), Of(kLfMainBoardState)});
  for (const robot::HandSpec& hand : spec.hands) {
    for (const std::string slow : {"", "lf/"}) {
      topics.push_back(
          {"rt/" + slow + hand.topic + "/state", &unitree_hg_msg_dds__HandState__desc});
    }
  }
  add(robot::TellsStateId(spec), {Of(kHgSportModeState), Of(kLfHgSportModeState)});
  add(spec.arm_action_state, {Of(kArmActionState)});
  return topics;
}

}  // namespace

std::vector<StateTopic> StateTopics(const robot::RobotSpec& spec) {
  return spec.family == robot::WireFamily::kGo ? GoTopics(spec) : HgTopics(spec);
}

}  // namespace understudy::wire
