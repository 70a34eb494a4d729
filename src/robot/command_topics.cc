#include "robot/command_topics.h"

#include "robot/hand_law.h"

namespace understudy::robot {

std::vector<std::string> CommandTopicNames(const RobotSpec& spec) {
  std::vector<std::string> topics(kCommandTopicNames.begin(), kCommandTopicNames.end());
  if (spec.arm_sdk.slots.empty()) topics[kArmSdkTopic].clear();
  if (!spec.user_lowcmd) topics[kUserLowCmdTopic].clear();
  if (!HasHandSdk(spec)) topics[kHandSdkTopic].clear();
  for (const HandSpec& hand : spec.hands) topics.push_back(HandCommandTopic(hand));
  return topics;
}

}  // namespace understudy::robot
