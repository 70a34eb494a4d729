#include "bus/now.h"

#include <dds/dds.h>

namespace understudy::bus {

std::chrono::nanoseconds Now() { return std::chrono::nanoseconds(dds_time()); }

}  // namespace understudy::bus
