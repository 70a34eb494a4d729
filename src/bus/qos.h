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

// What the vendor's writers offer (docs/sources.md#dds): RELIABLE, VOLATILE, KEEP_LAST 1,
// XCDR1 or XCDR2, sent as XCDR1. One thing differs, unseen by others: our writers may block for 0 s
// where the vendor's may for 100 ms.
QosPtr WriterQos();

// Takes what C++, Python and ROS 2 writers offer: VOLATILE, XCDR1 and XCDR2.
QosPtr ReaderQos(const ReaderOptions& options);

}  // namespace understudy::bus
