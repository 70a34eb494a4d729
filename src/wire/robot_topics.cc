#include "wire/robot_topics.h"

#include <algorithm>
#include <initializer_list>
#include <iterator>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "robot/command_topics.h"
#include "robot/firmware.h"
#include "robot/hand_law.h"

namespace understudy::wire {
namespace {

constexpr TopicName kAll[] = {
#define UNDERSTUDY_TOPIC(constant, name, module, type) topic::constant,
#define UNDERSTUDY_PLAIN_TOPIC UNDERSTUDY_TOPIC
#include "wire/topic_list.inc"
#undef UNDERSTUDY_PLAIN_TOPIC
#undef UNDERSTUDY_TOPIC
};

static_assert(robot::kCommandTopicNames[robot::kLowCmdTopic] == topic::kHgLowCmd.name &&
              robot::kCommandTopicNames[robot::kArmSdkTopic] == topic::kHgArmSdk.name &&
              robot::kCommandTopicNames[robot::kUserLowCmdTopic] == topic::kUserLowCmd.name &&
              robot::kCommandTopicNames[robot::kHandSdkTopic] == topic::kHandSdk.name);

constexpr std::string_view kServices = "rt/api/", kRequest = "/request", kResponse = "/response";

RobotTopic Topic(const TopicName& topic, double hz = 0) {
  return {std::string(topic.name), topic.type, hz};
}

// The types of a hand's messages, by HandLaw::Messages.
struct HandTypes {
  std::string_view command, state;
};
constexpr HandTypes kHandTypes[] = {
    {topic::kLeftDex3Cmd.type, topic::kLeftDex3State.type},
    {topic::kInspireCmd.type, topic::kInspireState.type},
    {topic::kLeftFtpCtrl.type, topic::kLeftFtpState.type},
};
const HandTypes& TypesOfHand(const robot::HandSpec& hand) {
  return kHandTypes[static_cast<std::size_t>(robot::LawOf(hand).messages)];
}

constexpr std::string_view kConfig = "config";  // the service that publishes its changes

}  // namespace

std::span<const TopicName> VendorTopics() { return kAll; }

std::string RequestTopic(std::string_view service) {
  return std::string(kServices).append(service).append(kRequest);
}
std::string ResponseTopic(std::string_view service) {
  return std::string(kServices).append(service).append(kResponse);
}
std::string LeaseOf(std::string_view service) { return std::string(service) + "_lease"; }

std::vector<std::string_view> TypesOf(std::string_view topic) {
  if (topic.starts_with(kServices) && topic.ends_with(kRequest)) return {kRequestType};
  if (topic.starts_with(kServices) && topic.ends_with(kResponse)) return {kResponseType};
  std::vector<std::string_view> types;
  for (const TopicName& one : kAll) {
    if (one.name == topic) types.push_back(one.type);
  }
  return types;
}

std::vector<RobotTopic> CommandTopics(const robot::RobotSpec& spec) {
  const bool go = spec.family == robot::WireFamily::kGo;
  std::vector<RobotTopic> topics;
  for (const std::string& name : robot::CommandTopicNames(spec)) {
    const std::size_t number = topics.size();
    topics.push_back({name, number >= robot::kFirstHandTopic
                                ? TypesOfHand(spec.hands[number - robot::kFirstHandTopic]).command
                            : number == robot::kHandSdkTopic ? topic::kHandSdk.type
                            : go                             ? topic::kGoLowCmd.type
                                                             : topic::kHgLowCmd.type});
  }
  return topics;
}

std::vector<StateMessage> StateMessages(const robot::RobotSpec& spec) {
  const robot::RateSpec& rates = spec.rates;
  const bool go = spec.family == robot::WireFamily::kGo;
  std::vector<StateMessage> messages;
  const auto add = [&](Content content, const TopicName& topic, double hz) {
    messages.push_back({.content = content, .topics = {Topic(topic, hz)}});
  };
  const auto add_twins = [&](Content content, const TopicName& topic, double hz,
                             const TopicName& slow) {
    add(content, topic, hz);
    messages.back().topics.push_back(Topic(slow, rates.lf_hz));
  };
  add_twins(Content::kLowState, go ? topic::kGoLowState : topic::kHgLowState, rates.lowstate_hz,
            go ? topic::kGoLfLowState : topic::kHgLfLowState);
  add_twins(Content::kMotion, go ? topic::kSportModeState : topic::kOdomModeState, rates.motion_hz,
            go ? topic::kLfSportModeState : topic::kLfOdomModeState);
  if (go) {
    add(Content::kRemote, topic::kWirelessController, rates.motion_hz);
    if (spec.error_list) add(Content::kErrors, topic::kErrorList, rates.lf_hz);
    // With a lidar of any make: the legs make it.
    if (robot::IsQuadruped(spec.kind) && robot::HasLidar(spec.lidar)) {
      constexpr double kHz =
          150;  // 148.7 to 150.6 on two Go2; every 8th is in the other, 18.1 to 18.8
      add(Content::kOdometry, topic::kLidarOdometry, kHz);
      add(Content::kOdometryPose, topic::kLidarPose, kHz / 8);
    }
    return messages;
  }
  if (!spec.imu.secondary_site.empty()) {
    add_twins(Content::kSecondImu, topic::kSecondaryImu, rates.lowstate_hz, topic::kLfSecondaryImu);
  }
  add(Content::kRemote, topic::kWirelessController, rates.motion_hz);
  add(Content::kBms, topic::kLfBmsState, rates.lf_hz);
  add(Content::kMainBoard, topic::kLfMainBoardState, rates.lf_hz);
  for (std::size_t i = 0; i < spec.hands.size(); ++i) {
    const robot::HandSpec& hand = spec.hands[i];
    const std::string_view type = TypesOfHand(hand).state;
    messages.push_back({.content = Content::kHand,
                        .topics = {{robot::HandTopic(hand, "state"), type, hand.hz}},
                        .hand = i});
    switch (robot::LawOf(hand).messages) {
      case robot::HandLaw::Messages::kHand:
        messages.back().topics.push_back({"rt/lf/" + hand.topic + "/state", type, rates.lf_hz});
        break;
      case robot::HandLaw::Messages::kMotors:
        break;
      case robot::HandLaw::Messages::kRegisters:
        messages.push_back({.content = Content::kTouch,
                            .topics = {{robot::HandTopic(hand, "touch"), topic::kLeftFtpTouch.type,
                                        hand.touch.hz}},
                            .hand = i});
        break;
    }
  }
  if (robot::TellsStateId(spec)) {
    add_twins(Content::kFsm, topic::kHgSportModeState, rates.motion_hz, topic::kLfHgSportModeState);
  }
  if (spec.arm_action_state) {
    constexpr double kHz = 10;  // a G1 with firmware 1.4.7, 3795 gaps of 0.102 s in the median
    add(Content::kArmAction, topic::kArmActionState, kHz);
  }
  return messages;
}

std::vector<LidarMessage> LidarMessages(const robot::RobotSpec& spec) {
  if (!robot::HasLidar(spec.lidar)) return {};
  if (!robot::IsMapped(spec.lidar)) {
    return {{Content::kCloud, Topic(topic::kLivoxCloud, 10)},
            {Content::kImuOfLidar, Topic(topic::kLivoxImu, 200)}};
  }
  // 14.97 to 15.0 on three Go2 with an L1, 15.13 to 15.43 on others with an L2.
  const double hz = spec.lidar.make == "L1" ? 15 : 216.0 / 14;
  return {{Content::kCloud, Topic(topic::kLidarCloud, hz)},
          {Content::kCloudBase, Topic(topic::kLidarCloudBase, hz)},
          {Content::kCloudDeskewed, Topic(topic::kLidarCloudDeskewed, hz)},
          {Content::kImuOfLidar, Topic(topic::kLidarImu, 250)},
          {Content::kStateOfLidar, Topic(topic::kLidarState, 4.87)},
          {Content::kClearance, Topic(topic::kLidarRange, hz)},  // *assumed*: no rate was seen
          {Content::kHeightMap, Topic(topic::kLidarHeights, 11.44)},
          {Content::kVoxelMap, Topic(topic::kLidarVoxels, 7.3)},   // as a receiver counted them
          {Content::kMapState, Topic(topic::kLidarMaps, 11.44)}};  // *assumed*: no rate was seen
}

std::vector<RobotTopic> ServiceTopics(const std::vector<std::string>& services,
                                      const std::vector<std::string>& status_texts) {
  std::vector<RobotTopic> topics;
  for (const std::string& service : services) {
    topics.push_back({ResponseTopic(service), kResponseType});
    topics.push_back({ResponseTopic(LeaseOf(service)), kResponseType});
  }
  if (std::ranges::count(services, kConfig) != 0)
    topics.push_back(Topic(topic::kConfigChangeStatus));
  for (const std::string& text : status_texts) {
    const auto* const row =
        std::ranges::find(kStatusTexts, std::string_view(text),
                          [](const StatusTextTopic& one) { return one.topic.name; });
    if (row == std::end(kStatusTexts)) {
      std::vector<std::string> words;
      for (const StatusTextTopic& known : kStatusTexts) words.emplace_back(known.topic.name);
      throw ConfigError("robot.status_texts: no topic '" + text + "'" + DidYouMean(text, words));
    }
    topics.push_back(Topic(row->topic, row->hz));
  }
  topics.push_back(Topic(topic::kServiceState));
  return topics;
}

std::vector<RobotTopic> PublishedTopics(const robot::RobotSpec& spec,
                                        const std::vector<std::string>& services) {
  std::vector<RobotTopic> topics;
  for (const StateMessage& message : StateMessages(spec)) {
    std::ranges::copy(message.topics, std::back_inserter(topics));
  }
  for (LidarMessage& message : LidarMessages(spec)) topics.push_back(std::move(message.topic));
  std::ranges::copy(ServiceTopics(services, spec.status_texts), std::back_inserter(topics));
  return topics;
}

}  // namespace understudy::wire
