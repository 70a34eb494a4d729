// Numbers the topics with commands to motors.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::robot {

inline constexpr std::size_t kLowCmdTopic = 0;
inline constexpr std::size_t kArmSdkTopic = 1;
inline constexpr std::size_t kUserLowCmdTopic = 2;
inline constexpr std::size_t kHandSdkTopic = 3;
inline constexpr std::size_t kFirstHandTopic = 4;  // then the other hands, as in RobotSpec::hands
inline constexpr std::size_t kMostCommandTopics = kFirstHandTopic + kMostHands;

// The names of the topics before those of hands.
inline constexpr std::array<std::string_view, kFirstHandTopic> kCommandTopicNames = {
    "rt/lowcmd", "rt/arm_sdk", "rt/user_lowcmd", "rt/hand_sdk"};

constexpr bool IsBodyCommandTopic(std::string_view topic) {
  return std::ranges::find(kCommandTopicNames, topic) < kCommandTopicNames.begin() + kHandSdkTopic;
}
// Of the hand of some robot (HandSpec::topic, or rt/hand_sdk).
constexpr bool IsHandCommandTopic(std::string_view topic) {
  return topic == kCommandTopicNames[kHandSdkTopic] || topic.ends_with("/cmd") ||
         topic.find("/ctrl/") != std::string_view::npos;
}

// Returns the topics of commands to a robot, by number; "" where it has none.
std::vector<std::string> CommandTopicNames(const RobotSpec& spec);

}  // namespace understudy::robot
