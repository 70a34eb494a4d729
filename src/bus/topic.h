// A topic's name and message type.
#pragma once

struct dds_topic_descriptor;

namespace understudy::bus {

// `Msg` is the C struct that idlc generated and `descriptor` its <Msg>_desc.
template <typename Msg>
struct Topic {
  const char* name;  // as on the wire, such as "rt/lowcmd"
  const dds_topic_descriptor* descriptor;
};

}  // namespace understudy::bus
