// The vendor's message types as ROS 2 writes message types down.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace understudy::record {

enum class Many { kOne, kArray, kSequence };  // a sequence is of any length

// One field of a message.
struct MessageField {
  std::string_view type;  // "float32" or another type's ROS name, "unitree_go/msg/MotorState"
  std::string_view name;
  Many many = Many::kOne;
  int count = 1;  // elements of an array
};

using MessageFields = std::vector<MessageField>;

// All types of the 73 by their ROS names. HelloWorldData::Msg, which is in no ROS package, is
// HelloWorldData/msg/Msg.
const std::map<std::string_view, MessageFields>& RosMessages();

// "unitree_go::msg::dds_::LowState_" -> "unitree_go/msg/LowState".
std::string RosTypeName(std::string_view type_on_wire);
// And back.
std::string TypeOnWire(std::string_view ros_type_name);

// "rt/lowstate" -> "/lowstate", as ROS 2 spells it; a topic without "rt/" stays as it is.
std::string RosTopicName(std::string_view topic_on_wire);

// The text of a ros2msg schema: the type's fields, then those of every type in it.
std::string Ros2MsgText(std::string_view ros_type_name);

}  // namespace understudy::record
