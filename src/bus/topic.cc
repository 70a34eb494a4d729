#include "bus/topic.h"

#include <dds/dds.h>

namespace understudy::bus {

std::string_view TypeName(const dds_topic_descriptor& descriptor) { return descriptor.m_typename; }

}  // namespace understudy::bus
