// Single numbers out of messages that are bytes.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "record/bytes.h"

namespace understudy::record {

// Where a number stands in every message of a type.
struct CdrField {
  std::string type;        // "float32"
  std::size_t offset = 0;  // from the end of the encoding's four bytes
};

// The field "motor_state[3].q" of a type by its ROS name; an array is named with an index. Throws
// RecordError with the nearest name for what there is not, and for what has no fixed place because
// a text or a sequence stands before it.
CdrField FindField(std::string_view ros_type_name, std::string_view path);

// Its value in a message as CdrSample::bytes() has it; nullopt where the message is too short or
// not little-endian XCDR1.
std::optional<double> ReadField(const CdrField& field, ByteSpan message);

}  // namespace understudy::record
