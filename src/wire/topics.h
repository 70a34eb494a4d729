// The topics of robots with the descriptors of their types, for readers and writers on the bus.
#pragma once

#include "bus/topic.h"
#include "idl/geometry_msgs.h"
#include "idl/inspire.h"
#include "idl/nav_msgs.h"
#include "idl/sensor_msgs.h"
#include "idl/std_msgs.h"
#include "idl/unitree_go.h"
#include "idl/unitree_hg.h"

namespace understudy::wire {

#define UNDERSTUDY_TOPIC(constant, name, module, type)            \
  inline constexpr bus::Topic<module##_msg_dds__##type> constant{ \
      name, &module##_msg_dds__##type##_desc};
#define UNDERSTUDY_PLAIN_TOPIC(constant, name, module, type) \
  inline constexpr bus::Topic<module##_##type> constant{name, &module##_##type##_desc};
#include "wire/topic_list.inc"
#undef UNDERSTUDY_PLAIN_TOPIC
#undef UNDERSTUDY_TOPIC

}  // namespace understudy::wire
