// Names what stands where in a message, by the schema that its recording has.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "record/bytes.h"

namespace understudy::record {

// A value of one message.
struct SchemaField {
  std::string path;        // "motor_state[3].q"
  std::string type;        // "float32", "string"; of the length of a sequence ""
  std::size_t offset = 0;  // bytes, after the four bytes of the encoding
};

// Returns the value that has the byte at `at` of `message`, in the form of CdrSample::bytes();
// `schema` is a ros2msg text. nullopt if no value has it, or if the message does not fit the
// schema.
std::optional<SchemaField> FieldWithByte(std::string_view schema, ByteSpan message, std::size_t at);

// Returns a value as text: "0.67", "'ended'", "3 elements"; "" if the message is too short for it.
std::string ValueText(const SchemaField& field, ByteSpan message);

}  // namespace understudy::record
