#include "record/cdr_field.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <vector>

#include "base/nearest_word.h"
#include "record/ros2msg.h"

namespace understudy::record {

std::size_t NumberSize(std::string_view primitive) {
  if (primitive == "bool" || primitive.ends_with("int8")) return 1;
  if (primitive.ends_with("int16")) return 2;
  if (primitive.ends_with("32")) return 4;
  if (primitive.ends_with("64")) return 8;
  return 0;
}

namespace {

constexpr std::size_t kHead = 4;

[[noreturn]] void HasNoPlace(std::string_view type, const MessageField& field) {
  throw RecordError(std::string(type) + "." + std::string(field.name) +
                    ": has no fixed place, and nothing after it");
}

// Advances `offset` past all elements of a field, or past the first `count`.
void Skip(std::string_view in, const MessageField& field, int count, std::size_t* offset) {
  const auto message = RosMessages().find(field.type);
  if (field.many == Many::kSequence ||
      (message == RosMessages().end() && NumberSize(field.type) == 0)) {
    HasNoPlace(in, field);
  }
  for (int i = 0; i < count; ++i) {
    if (message != RosMessages().end()) {
      for (const MessageField& inner : message->second) {
        Skip(field.type, inner, inner.count, offset);
      }
    } else {
      const std::size_t size = NumberSize(field.type);
      *offset = (*offset + size - 1) / size * size + size;
    }
  }
}

// Splits "motor_state[3]" into name and index; the index is -1 if there is none.
std::pair<std::string, int> Split(std::string_view word) {
  const std::size_t bracket = word.find('[');
  if (bracket == std::string_view::npos) return {std::string(word), -1};
  int index = -1;
  const char* end = word.data() + word.size();
  const auto [rest, error] = std::from_chars(word.data() + bracket + 1, end, index);
  if (error != std::errc{} || index < 0 || std::string_view(rest, end) != "]") {
    throw RecordError("'" + std::string(word) + "': expected a name and [index]");
  }
  return {std::string(word.substr(0, bracket)), index};
}

CdrField FindFrom(std::string_view type, std::string_view path, std::size_t offset) {
  const auto message = RosMessages().find(type);
  if (message == RosMessages().end()) {
    throw RecordError("no message type '" + std::string(type) + "'");
  }
  const std::size_t dot = std::min(path.find('.'), path.size());
  const auto [name, index] = Split(path.substr(0, dot));
  std::vector<std::string> names;
  for (const MessageField& field : message->second) {
    names.emplace_back(field.name);
    if (field.name != name) {
      // An error only if the wanted field comes after it.
      if (std::ranges::find(message->second, name, &MessageField::name) != message->second.end()) {
        Skip(type, field, field.count, &offset);
      }
      continue;
    }
    if (field.many == Many::kSequence || field.type == "string") HasNoPlace(type, field);
    if ((field.many == Many::kArray) != (index >= 0) || index >= field.count) {
      throw RecordError(std::string(type) + "." + name + ": " +
                        ((field.many == Many::kArray)
                             ? "expected an index from 0 to " + std::to_string(field.count - 1)
                             : "is no array"));
    }
    Skip(type, field, std::max(index, 0), &offset);
    if (RosMessages().contains(field.type)) {
      return FindFrom(field.type, dot == path.size() ? "" : path.substr(dot + 1), offset);
    }
    if (dot != path.size()) throw RecordError(std::string(type) + "." + name + ": is a number");
    const std::size_t size = NumberSize(field.type);
    return {.type = std::string(field.type), .offset = (offset + size - 1) / size * size};
  }
  throw RecordError(std::string(type) + " has no field '" + name + "'" + DidYouMean(name, names));
}

template <typename Number>
double Read(const std::byte* at) {
  Number number;
  std::memcpy(&number, at, sizeof(number));
  return static_cast<double>(number);
}

}  // namespace

CdrField FindField(std::string_view ros_type_name, std::string_view path) {
  return FindFrom(ros_type_name, path, 0);
}

std::optional<double> ReadField(const CdrField& field, ByteSpan message) {
  const std::size_t at = kHead + field.offset;
  if (message.size() < at + NumberSize(field.type) || message[0] != std::byte{0} ||
      message[1] != std::byte{1}) {
    return std::nullopt;
  }
  using Reading = double (*)(const std::byte*);
  constexpr auto kReadings =
      std::to_array<std::pair<std::string_view, Reading>>({{"bool", &Read<std::uint8_t>},
                                                           {"uint8", &Read<std::uint8_t>},
                                                           {"int8", &Read<std::int8_t>},
                                                           {"uint16", &Read<std::uint16_t>},
                                                           {"int16", &Read<std::int16_t>},
                                                           {"uint32", &Read<std::uint32_t>},
                                                           {"int32", &Read<std::int32_t>},
                                                           {"uint64", &Read<std::uint64_t>},
                                                           {"int64", &Read<std::int64_t>},
                                                           {"float32", &Read<float>},
                                                           {"float64", &Read<double>}});
  for (const auto& [type, read] : kReadings) {
    if (type == field.type) return read(message.data() + at);
  }
  return std::nullopt;
}

}  // namespace understudy::record
