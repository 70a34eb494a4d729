// Orders that take hold of a body.
#include <cmath>
#include <utility>

#include "server/json_body.h"
#include "server/order_json.h"

namespace understudy::server {

using nlohmann::json;

OrderReading ReadPushOrder(std::string_view body) {
  const auto read = ReadObject(body, {"body", "force", "seconds"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  emulator::PushBody push{.seconds = SecondsOf(object, kMostSeconds)};
  if (!(push.seconds > 0)) return std::string{"\"seconds\": expected how long it acts"};
  const auto name = object.find("body");
  if (name != object.end()) {
    if (!name->is_string()) return Expected("body", "the name of a body", *name);
    push.body = name->get<std::string>();
  }
  const auto force = ReadVector(object, "force", kMostForce, "three numbers in N");
  if (const auto* why = std::get_if<std::string>(&force)) return *why;
  push.force = std::get<Eigen::Vector3d>(force);
  return emulator::Order{push};
}

OrderReading ReadDragOrder(std::string_view body) {
  const auto read = ReadObject(body, {"body", "at", "to", "seconds", "release"});
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);

  std::string name;
  if (const auto named = object.find("body"); named != object.end()) {
    if (!named->is_string()) return Expected("body", "the name of a body", *named);
    name = named->get<std::string>();
  }
  if (const auto release = object.find("release"); release != object.end()) {
    if (*release != true) return Expected("release", "true", *release);
    if (object.size() > (object.contains("body") ? 2 : 1)) {
      return std::string{"\"release\" takes nothing but \"body\" beside it"};
    }
    return emulator::Order{emulator::ReleaseDrag{.body = std::move(name)}};
  }

  if (name.empty()) return std::string{"\"body\": expected the name of a body"};
  emulator::DragBody drag{.body = std::move(name)};
  if (object.contains("at")) {
    const auto at = ReadVector(object, "at", kFarthestOnBody, "three numbers in m, at most 10");
    if (const auto* why = std::get_if<std::string>(&at)) return *why;
    drag.p_BP = std::get<Eigen::Vector3d>(at);
  }
  const auto to = ReadVector(object, "to", kFarthestInWorld, "three numbers in m, at most 1e6");
  if (const auto* why = std::get_if<std::string>(&to)) return *why;
  drag.p_WT = std::get<Eigen::Vector3d>(to);
  drag.seconds = SecondsOf(object, kLongestDrag, drag.seconds);
  if (!(drag.seconds > 0)) {
    return Expected("seconds", "more than 0 and at most 60", object["seconds"]);
  }
  return emulator::Order{std::move(drag)};
}

}  // namespace understudy::server
