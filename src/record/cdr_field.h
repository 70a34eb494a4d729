// Reads single numbers of serialized messages.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "record/bytes.h"

namespace understudy::record {

// The position of a number in all messages of a type.
struct CdrField {
  std::string type;        // "float32"
  std::size_t offset = 0;  // bytes, after the four bytes of the encoding
};

// Returns the bytes of a number by its type's name in ros2msg, such as "float32"; 0 of another
// type.
std::size_t NumberSize(std::string_view type);

// Returns the field `path`, such as "motor_state[3].q", of a type by its ROS name; arrays need an
// index. Throws RecordError, with the nearest name, for a field that does not exist, and for one
// without a fixed position because a text or sequence precedes it.
CdrField FindField(std::string_view ros_type_name, std::string_view path);

// Returns its value in a message in the form of CdrSample::bytes(); nullopt if the message is too
// short or not little-endian XCDR1.
std::optional<double> ReadField(const CdrField& field, ByteSpan message);

}  // namespace understudy::record
