#include "record/ros2msg.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <set>
#include <utility>

#include "idl/sources.h"

namespace understudy::record {
namespace {

using Messages = std::map<std::string, MessageFields, std::less<>>;

constexpr auto kPrimitives =
    std::to_array<std::pair<std::string_view, std::string_view>>({{"boolean", "bool"},
                                                                  {"double", "float64"},
                                                                  {"float", "float32"},
                                                                  {"int16", "int16"},
                                                                  {"int32", "int32"},
                                                                  {"int64", "int64"},
                                                                  {"int8", "int8"},
                                                                  {"string", "string"},
                                                                  {"uint16", "uint16"},
                                                                  {"uint32", "uint32"},
                                                                  {"uint64", "uint64"},
                                                                  {"uint8", "uint8"}});

// Words and single signs, without comments and # lines. "a::b" is one word.
std::vector<std::string_view> Words(std::string_view text) {
  std::vector<std::string_view> words;
  const auto is_word = [](char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_' || c == ':' || c == '@';
  };
  while (!text.empty()) {
    if (text.starts_with("//") || text.front() == '#') {
      text.remove_prefix(std::min(text.find('\n'), text.size()));
    } else if (std::isspace(static_cast<unsigned char>(text.front())) != 0) {
      text.remove_prefix(1);
    } else {
      const auto end = std::ranges::find_if_not(text, is_word);
      const auto size = std::max<std::size_t>(1, static_cast<std::size_t>(end - text.begin()));
      words.push_back(text.substr(0, size));
      text.remove_prefix(size);
    }
  }
  return words;
}

// Reads as much of IDL as idl/ has: modules and structs of numbers, strings, other structs, arrays
// and sequences.
class IdlReader {
 public:
  explicit IdlReader(std::string_view text) : words_(Words(text)) {}

  void ReadInto(Messages* messages) {
    std::vector<std::string> modules;
    while (at_ < words_.size()) {
      const std::string_view word = Next();
      if (word == "module") {
        modules.emplace_back(Next());
        Next();  // {
      } else if (word == "struct") {
        std::string scope;
        for (const std::string& module : modules) scope += module + "::";
        const std::string name(Next());
        Next();  // {
        (*messages)[RosTypeName(scope + name)] = ReadFields(scope);
      } else if (word == "}") {
        modules.pop_back();
      }
    }
  }

 private:
  std::string_view Next() { return words_[at_++]; }

  // Up to the closing brace.
  MessageFields ReadFields(const std::string& scope) {
    MessageFields fields;
    for (std::string_view word = Next(); word != "}"; word = Next()) {
      MessageField field;
      if (word == "sequence") {
        field.is_sequence = true;
        Next();  // <
        field.type = RosType(Next(), scope);
        Next();  // >
      } else {
        field.type = RosType(word, scope);
      }
      field.name = Next();
      if (Next() == "[") {
        field.is_array = true;
        field.count = std::stoi(std::string(Next()));
        Next();  // ]
        Next();  // ;
      }
      fields.push_back(std::move(field));
    }
    return fields;
  }

  static std::string RosType(std::string_view type, const std::string& scope) {
    const auto* primitive =
        std::ranges::find(kPrimitives, type, [](const auto& p) { return p.first; });
    if (primitive != kPrimitives.end()) return std::string(primitive->second);
    if (type.find("::") != std::string_view::npos) return RosTypeName(type);
    return RosTypeName(scope + std::string(type));
  }

  std::vector<std::string_view> words_;
  std::size_t at_ = 0;
};

std::string Fields(std::string_view type) {
  std::string text;
  for (const MessageField& field : RosMessages().find(type)->second) {
    // Nested types are named without the "msg" between package and name.
    std::string name = field.type;
    if (const std::size_t at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
    if (field.is_array) name += "[" + std::to_string(field.count) + "]";
    if (field.is_sequence) name += "[]";
    text += name + " " + field.name + "\n";
  }
  return text;
}

// The types in a type, each once, those it holds itself first.
void Collect(std::string_view type, std::set<std::string>* seen, std::vector<std::string>* types) {
  for (const MessageField& field : RosMessages().find(type)->second) {
    if (RosMessages().contains(field.type) && seen->insert(field.type).second) {
      types->push_back(field.type);
      Collect(field.type, seen, types);
    }
  }
}

}  // namespace

const Messages& RosMessages() {
  static const Messages messages = [] {
    Messages read;
    for (const std::string_view source : IdlSources()) IdlReader(source).ReadInto(&read);
    return read;
  }();
  return messages;
}

std::string RosTypeName(std::string_view type_on_wire) {
  const std::size_t package = type_on_wire.find("::");
  if (package == std::string_view::npos) return std::string(type_on_wire);
  std::string_view name = type_on_wire.substr(type_on_wire.rfind("::") + 2);
  if (name.ends_with('_')) name.remove_suffix(1);
  return std::string(type_on_wire.substr(0, package)) + "/msg/" + std::string(name);
}

std::string TypeOnWire(std::string_view ros_type_name) {
  if (ros_type_name == "HelloWorldData/msg/Msg") return "HelloWorldData::Msg";
  const std::size_t at = ros_type_name.find("/msg/");
  if (at == std::string_view::npos) return {};
  return std::string(ros_type_name.substr(0, at)) +
         "::msg::dds_::" + std::string(ros_type_name.substr(at + 5)) + "_";
}

std::string RosTopicName(std::string_view topic_on_wire) {
  return std::string(topic_on_wire.starts_with("rt/") ? topic_on_wire.substr(2) : topic_on_wire);
}

std::string Ros2MsgText(std::string_view ros_type_name) {
  std::set<std::string> seen;
  std::vector<std::string> types;
  Collect(ros_type_name, &seen, &types);
  std::string text = Fields(ros_type_name);
  for (std::string& type : types) {
    const std::string fields = Fields(type);
    type.erase(type.find("/msg/"), 4);
    text += std::string(80, '=') + "\nMSG: " + type + "\n" + fields;
  }
  return text;
}

}  // namespace understudy::record
