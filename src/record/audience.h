// Hears what is written to a recording.
#pragma once

#include <cstdint>
#include <string_view>

#include "record/mcap_format.h"

namespace understudy::record {

// Called in the recorder's thread, in the order of the file. May throw: the recording then stops.
class Audience {
 public:
  virtual ~Audience() = default;

  // Before all else; `start` [ns since 1970] is the log time of step 0.
  virtual void Begin(std::uint64_t start) = 0;
  // A message, whose data is valid during the call. `sequence` is not set.
  virtual void Hear(const McapChannel& channel, std::string_view ros_type,
                    const McapMessage& message) = 0;
};

}  // namespace understudy::record
