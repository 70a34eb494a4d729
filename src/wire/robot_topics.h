// The topics of robots, without a bus: names, types and rates.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "robot/robot_spec.h"

namespace understudy::wire {

struct TopicName {
  std::string_view name, type;  // on the wire: "rt/lowcmd", "unitree_go::msg::dds_::LowCmd_"
};

// The topics of topic_list.inc by name; topics.h has them with their descriptors.
namespace topic {
#define UNDERSTUDY_TOPIC(constant, name, module, type) \
  inline constexpr TopicName constant{name, #module "::msg::dds_::" #type};
#define UNDERSTUDY_PLAIN_TOPIC(constant, name, module, type) \
  inline constexpr TopicName constant{name, #module "::" #type};
#include "wire/topic_list.inc"
#undef UNDERSTUDY_PLAIN_TOPIC
#undef UNDERSTUDY_TOPIC
}  // namespace topic

// The names that both families have, each with a type of its own.
inline constexpr std::string_view kLowCmdName = topic::kGoLowCmd.name,
                                  kLowStateName = topic::kGoLowState.name;

// Returns all of them.
std::span<const TopicName> VendorTopics();

inline constexpr std::string_view kRequestType = "unitree_api::msg::dds_::Request_";
inline constexpr std::string_view kResponseType = "unitree_api::msg::dds_::Response_";

std::string RequestTopic(std::string_view service);
std::string ResponseTopic(std::string_view service);
// The name under which a service's lease is asked for.
std::string LeaseOf(std::string_view service);

// Returns the types that a topic of the vendor's robots has, those of services among them; none for
// any other topic.
std::vector<std::string_view> TypesOf(std::string_view topic);

// A topic of one robot.
struct RobotTopic {
  std::string name;
  std::string_view type;
  double hz = 0;  // of simulated time; 0: sent when something happens, or received
};

// Returns the topics of commands to a robot, by number (robot/command_topics.h); the name is ""
// where it has none.
std::vector<RobotTopic> CommandTopics(const robot::RobotSpec& spec);

// What a message has. All but those of a LidarReading are made of a RobotState.
enum class Content : std::uint8_t {
  kLowState,
  kMotion,  // where the base is, and what the motion service does
  kRemote,
  kErrors,
  kOdometry,
  kOdometryPose,
  kSecondImu,
  kBms,
  kMainBoard,
  kHand,
  kTouch,  // what the pads of a hand show
  kFsm,    // the state of a humanoid's motion service
  kArmAction,
  // Of a LidarReading.
  kCloud,  // in the lidar's frame
  kImuOfLidar,
  kStateOfLidar,
  // The same from programs that need to know where the base is.
  kCloudBase,  // in the base's frame
  kCloudDeskewed,
  kClearance,
  kHeightMap,
  kVoxelMap,
  kMapState,  // of both maps
};

// A message with its topics; the rt/lf twin is one of them.
struct StateMessage {
  Content content;
  std::vector<RobotTopic> topics;
  std::size_t hand = 0;  // of kHand and kTouch: RobotSpec::hands
};
std::vector<StateMessage> StateMessages(const robot::RobotSpec& spec);

// What a lidar says, with its topic.
struct LidarMessage {
  Content content;
  RobotTopic topic;
};
std::vector<LidarMessage> LidarMessages(const robot::RobotSpec& spec);

// Returns the topics on which services and programs of a robot publish: responses, changes of the
// configuration, texts. Throws ConfigError for a text that is none of kStatusTexts.
std::vector<RobotTopic> ServiceTopics(const std::vector<std::string>& services,
                                      const std::vector<std::string>& status_texts);

// The texts that programs publish by themselves. Rates: seen on Go2 and G1
// (docs/dev/sources.md#notes-on-real-robots); that of public_network_status is assumed.
struct StatusTextTopic {
  TopicName topic;
  double hz;
};
inline constexpr StatusTextTopic kStatusTexts[] = {{topic::kRtcState, 1},
                                                   {topic::kMultipleState, 1},
                                                   {topic::kGnss, 1},
                                                   {topic::kAudioPlayerState, 4},
                                                   {topic::kPublicNetworkStatus, 1}};

// Returns all topics on which a robot publishes, in the order of its outlets (outlets.h): those of
// its states and lidar, then those of these services (services::ServiceNames). Throws as
// ServiceTopics.
std::vector<RobotTopic> PublishedTopics(const robot::RobotSpec& spec,
                                        const std::vector<std::string>& services);

}  // namespace understudy::wire
