#pragma once

#include <span>
#include <string_view>

struct dds_topic_descriptor;

namespace understudy {

// One of the vendor's message types.
struct MessageType {
  // The type's name on the wire, such as "unitree_go::msg::dds_::LowCmd_".
  std::string_view name;
  // What idlc generated for it: never null, lives as long as the program, and is what
  // dds_create_topic() takes.
  const dds_topic_descriptor* descriptor;
};

// Every message type of unitree_sdk2, 73 of them, and three of Inspire's hands, in ascending order
// of name, each once. Good before main() too.
std::span<const MessageType> MessageTypes();

// The type with exactly this name on the wire, or nullptr when the vendor has none of that name.
// No prefix, alias or ROS spelling ("unitree_go/msg/LowCmd") is understood.
const MessageType* FindMessageType(std::string_view name);

}  // namespace understudy
