#include "record/ros2msg.h"

#include <set>

namespace understudy::record {
namespace {

using Messages = std::map<std::string_view, MessageFields>;

std::string Fields(std::string_view type) {
  std::string text;
  for (const MessageField& field : RosMessages().find(type)->second) {
    // Nested types are written without the "msg" between package and name.
    std::string name(field.type);
    if (const std::size_t at = name.find("/msg/"); at != std::string::npos) name.erase(at, 4);
    if (field.many == Many::kArray) name += "[" + std::to_string(field.count) + "]";
    if (field.many == Many::kSequence) name += "[]";
    text += name.append(" ").append(field.name) + "\n";
  }
  return text;
}

// Adds the nested types of a type, each once, direct members first.
void Collect(std::string_view type, std::set<std::string_view>* seen,
             std::vector<std::string_view>* types) {
  for (const MessageField& field : RosMessages().find(type)->second) {
    if (RosMessages().contains(field.type) && seen->insert(field.type).second) {
      types->push_back(field.type);
      Collect(field.type, seen, types);
    }
  }
}

}  // namespace

const Messages& RosMessages() {
  // Generated from idl/ by cmake/RosFields.cmake.
  static const Messages messages = {
#include "ros_fields.inc"
  };
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
  if (ros_type_name.starts_with("inspire/")) {
    return "inspire::" + std::string(ros_type_name.substr(at + 5));
  }
  return std::string(ros_type_name.substr(0, at)) +
         "::msg::dds_::" + std::string(ros_type_name.substr(at + 5)) + "_";
}

std::string RosTopicName(std::string_view topic_on_wire) {
  return std::string(topic_on_wire.starts_with("rt/") ? topic_on_wire.substr(2) : topic_on_wire);
}

std::string Ros2MsgText(std::string_view ros_type_name) {
  std::set<std::string_view> seen;
  std::vector<std::string_view> types;
  Collect(ros_type_name, &seen, &types);
  std::string text = Fields(ros_type_name);
  for (const std::string_view type : types) {
    std::string name(type);
    name.erase(name.find("/msg/"), 4);
    text += std::string(80, '=') + "\nMSG: " + name + "\n" + Fields(type);
  }
  return text;
}

}  // namespace understudy::record
