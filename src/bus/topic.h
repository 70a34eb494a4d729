// A topic's name and message type.
#pragma once

#include <string_view>

struct dds_topic_descriptor;

namespace understudy::bus {

// `Msg` is the C struct that idlc generated and `descriptor` its <Msg>_desc.
template <typename Msg>
struct Topic {
  const char* name;  // as on the wire, such as "rt/lowcmd"
  const dds_topic_descriptor* descriptor;
};

// Returns the type's name on the wire, such as "unitree_go::msg::dds_::LowCmd_".
std::string_view TypeName(const dds_topic_descriptor& descriptor);

}  // namespace understudy::bus
