#include "record/schema_field.h"

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <functional>
#include <map>
#include <sstream>
#include <vector>

#include "base/printed.h"
#include "record/cdr_field.h"
#include "record/cdr_out.h"
#include "record/ros2msg.h"

namespace understudy::record {
namespace {

constexpr int kMostNested = 16;  // *assumed*: those of ROS and of the vendor have five

struct SchemaLine {
  std::string type, name;
  Many many = Many::kOne;
  std::size_t count = 1;  // of an array
};

// The fields of each type; those of the message itself are under "".
using Definitions = std::map<std::string, std::vector<SchemaLine>, std::less<>>;

SchemaLine LineOf(std::string type, std::string name) {
  SchemaLine line{.type = {}, .name = std::move(name)};
  if (const std::size_t bracket = type.find('['); bracket != std::string::npos) {
    const char* const end = type.data() + type.size();
    const auto [rest, error] = std::from_chars(type.data() + bracket + 1, end, line.count);
    line.many = error == std::errc{} && *rest == ']' ? Many::kArray : Many::kSequence;
    type.erase(bracket);
  }
  if (type.starts_with("string<=")) type = "string";
  if (const std::size_t folder = type.find("/msg/"); folder != std::string::npos) {
    type.erase(folder, 4);
  }
  line.type = std::move(type);
  return line;
}

Definitions Parse(std::string_view schema) {
  Definitions definitions;
  std::vector<SchemaLine>* fields = &definitions[""];
  std::istringstream lines{std::string(schema)};
  for (std::string text; std::getline(lines, text);) {
    std::istringstream words(text.substr(0, text.find('#')));
    std::string type, name;
    if (!(words >> type >> name)) continue;
    if (type == "MSG:") {
      fields = &definitions[name];
    } else if (name.find('=') == std::string::npos) {  // no constant
      fields->push_back(LineOf(std::move(type), std::move(name)));
    }
  }
  return definitions;
}

// Goes through a message up to the value that has the byte `wanted` after the encoding.
class Walk {
 public:
  Walk(const Definitions& definitions, ByteSpan message, std::size_t wanted)
      : definitions_(definitions), in_(message), wanted_(wanted) {}

  // Each returns true when it has found the value. They throw RecordError at the message's end.
  bool Fields(const std::string& type, const std::string& path, int depth = 0) {
    const auto found = definitions_.find(type);
    if (found == definitions_.end() || depth > kMostNested) throw RecordError("no type " + type);
    return std::ranges::any_of(found->second, [&](const SchemaLine& line) {
      return Field(line, path.empty() ? line.name : path + "." + line.name, depth);
    });
  }

  const SchemaField& found() const { return found_; }

 private:
  bool Field(const SchemaLine& line, const std::string& path, int depth) {
    std::size_t count = line.count;
    if (line.many == Many::kSequence) {
      const std::size_t at = Aligned(sizeof(std::uint32_t));
      count = in_.Take<std::uint32_t>();
      if (Covers(path, "", at)) return true;
    }
    const auto element = [&](std::size_t i) {
      return line.many == Many::kOne ? path : path + "[" + std::to_string(i) + "]";
    };
    if (const std::size_t size = NumberSize(line.type); size > 0 && count > 0) {
      const std::size_t at = Aligned(size);
      in_.TakeRaw(std::uint64_t{size} * count);
      const std::size_t i = std::max(wanted_, at) - at;
      return Covers(element(i / size), line.type, at + i / size * size);
    }
    for (std::size_t i = 0; i < count; ++i) {
      if (in_.remaining() == 0) throw RecordError("it ends");
      if (line.type == "string") {
        const std::size_t at = Aligned(sizeof(std::uint32_t));
        in_.TakeString();
        if (Covers(element(i), line.type, at)) return true;
      } else if (Fields(line.type, element(i), depth + 1)) {
        return true;
      }
    }
    return false;
  }

  // Returns where the next value of that alignment begins.
  std::size_t Aligned(std::size_t to) {
    in_.Align(to);
    return in_.position();
  }

  // Whether the value that was taken last has the byte, or the padding before it.
  bool Covers(const std::string& path, const std::string& type, std::size_t at) {
    if (wanted_ >= in_.position()) return false;
    found_ = {.path = path, .type = type, .offset = at};
    return true;
  }

  const Definitions& definitions_;
  BytesIn in_;
  std::size_t wanted_;
  SchemaField found_;
};

bool IsLittleEndian(ByteSpan message) {
  return message.size() >= kCdrHead && message[0] == std::byte{0} && message[1] == std::byte{1};
}

}  // namespace

std::optional<SchemaField> FieldWithByte(std::string_view schema, ByteSpan message,
                                         std::size_t at) {
  if (at < kCdrHead || !IsLittleEndian(message)) return std::nullopt;
  const Definitions definitions = Parse(schema);
  Walk walk(definitions, message.subspan(kCdrHead), at - kCdrHead);
  try {
    if (!walk.Fields("", "")) return std::nullopt;
  } catch (const RecordError&) {  // it does not fit
    return std::nullopt;
  }
  return walk.found();
}

std::string ValueText(const SchemaField& field, ByteSpan message) {
  const bool is_text = field.type == "string";
  const CdrField place{.type = is_text || field.type.empty() ? "uint32" : field.type,
                       .offset = field.offset};
  const std::optional<double> number = ReadField(place, message);
  if (!number) return "";
  if (!is_text) return Printed(field.type.empty() ? "%.9g elements" : "%.9g", *number);
  const ByteSpan rest = message.subspan(kCdrHead + field.offset + sizeof(std::uint32_t));
  std::string text(reinterpret_cast<const char*>(rest.data()),
                   std::min(static_cast<std::size_t>(*number), rest.size()));
  return "'" + Printable(text.substr(0, text.find('\0'))) + "'";
}

}  // namespace understudy::record
