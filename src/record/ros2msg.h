// Describes the vendor's message types as ROS 2 message definitions.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::record {

enum class Many { kOne, kArray, kSequence };  // a sequence has any length

// One field of a message.
struct MessageField {
  std::string_view type;  // "float32" or another type's ROS name, "unitree_go/msg/MotorState"
  std::string_view name;
  Many many = Many::kOne;
  int count = 1;  // elements of an array
};

using MessageFields = std::vector<MessageField>;

// Returns the types of idl/type_table.h by their ROS names. HelloWorldData::Msg, which is in no ROS
// package, is HelloWorldData/msg/Msg, inspire::inspire_hand_ctrl inspire/msg/inspire_hand_ctrl.
const std::map<std::string_view, MessageFields>& RosMessages();

// "unitree_go::msg::dds_::LowState_" -> "unitree_go/msg/LowState".
std::string RosTypeName(std::string_view type_on_wire);
// The inverse.
std::string TypeOnWire(std::string_view ros_type_name);

// "rt/lowstate" -> "/lowstate"; a topic without "rt/" is unchanged.
std::string RosTopicName(std::string_view topic_on_wire);

// Returns the text of a ros2msg schema: the fields of the type, then those of all nested types.
std::string Ros2MsgText(std::string_view ros_type_name);

}  // namespace understudy::record
