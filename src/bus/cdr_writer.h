// A writer of messages that are bytes already.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "bus/participant.h"
#include "bus/topic.h"

namespace understudy::bus {

// Sends as a Writer does: reliable, and nobody holds it up.
class CdrWriter {
 public:
  // Throws BusError when Cyclone refuses. `descriptor` must outlive the writer.
  CdrWriter(const Participant& participant, const std::string& topic,
            const dds_topic_descriptor& descriptor);

  // Readers matched now.
  int matched_readers() const;

  // One message as CdrSample::bytes() has it. The bytes may come from anywhere: those that are no
  // message of the type are not sent, and the answer is false.
  bool Write(std::span<const std::byte> bytes);

 private:
  const dds_topic_descriptor& descriptor_;
  Entity topic_;
  Entity writer_;
  std::vector<char> encoded_;
  std::vector<char> message_;  // the type's C struct
};

}  // namespace understudy::bus
