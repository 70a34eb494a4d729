// Quality of service of our readers and writers. Private to bus/.
#pragma once

#include <memory>

#include <dds/dds.h>

#include "bus/reader.h"

namespace understudy::bus {

struct QosDeleter {
  void operator()(dds_qos_t* qos) const { dds_delete_qos(qos); }
};
using QosPtr = std::unique_ptr<dds_qos_t, QosDeleter>;

// As the vendor's writers (docs/dev/sources.md#dds): RELIABLE, VOLATILE, KEEP_LAST 1, XCDR1 or
// XCDR2, sent as XCDR1. Only the blocking time differs, which others cannot see: 0 s instead of 100
// ms.
QosPtr WriterQos();

// Compatible with C++, Python and ROS 2 writers: VOLATILE, XCDR1 and XCDR2.
QosPtr ReaderQos(const ReaderOptions& options);

}  // namespace understudy::bus
