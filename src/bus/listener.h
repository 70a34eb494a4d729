// What Cyclone calls when something happens to a reader or writer. Private to bus/.
#pragma once

#include <memory>

#include <dds/dds.h>

namespace understudy::bus {

struct ListenerDeleter {
  void operator()(dds_listener_t* listener) const { dds_delete_listener(listener); }
};
using ListenerPtr = std::unique_ptr<dds_listener_t, ListenerDeleter>;

// Its functions get `argument`, which must outlive whom it listens to.
inline ListenerPtr MakeListener(void* argument) {
  return ListenerPtr(dds_create_listener(argument));
}

}  // namespace understudy::bus
