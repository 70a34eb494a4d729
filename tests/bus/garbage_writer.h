// A writer that sends bytes of another type than the topic's.
#pragma once

#include <string>

#include "idl/std_msgs.h"
#include "tests/bus/stranger.h"

namespace understudy::bus {

// Writes bytes of one type under the name of another, as a program does that was built with other
// IDL.
class GarbageWriter {
 public:
  GarbageWriter(const Stranger& stranger, const char* topic, const dds_topic_descriptor_t& disguise)
      : type_{.m_size = std_msgs_msg_dds__String__desc.m_size,
              .m_align = std_msgs_msg_dds__String__desc.m_align,
              .m_flagset = 0,  // without its XTypes description, by which it would not match
              .m_nkeys = 0,
              .m_typename = disguise.m_typename,
              .m_keys = nullptr,
              .m_nops = std_msgs_msg_dds__String__desc.m_nops,
              .m_ops = std_msgs_msg_dds__String__desc.m_ops,
              .m_meta = std_msgs_msg_dds__String__desc.m_meta,
              .type_information = {},
              .type_mapping = {},
              .restrict_data_representation = 0},
        writer_(
            dds_create_writer(stranger.handle(),
                              dds_create_topic(stranger.handle(), &type_, topic, nullptr, nullptr),
                              StrangerQos{}.Make().get(), nullptr),
            "create the stranger's writer") {}

  void Send(std::string text = "garbage") const {
    const std_msgs_msg_dds__String_ message{.data = text.data()};
    dds_write(writer_.handle(), &message);
  }

 private:
  dds_topic_descriptor_t type_;
  Entity writer_;
};

}  // namespace understudy::bus
