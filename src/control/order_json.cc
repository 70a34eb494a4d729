#include "control/order_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "robot/nearest_word.h"
#include "robot/remote_keys.h"

namespace understudy {
namespace {

using nlohmann::json;

// One key that a body may hold, and what its value means.
struct OrderKey {
  std::string_view name;
  OrderReading (*read)(std::string_view name, const json& value);
};

// A value for a message: what is not UTF-8 is replaced, what is long is cut. Of arrays and objects
// only the kind, for dump recurses and a client chooses how deep.
std::string Shown(const json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_structured()) return std::string{"an "} + value.type_name();
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

std::string Expected(std::string_view name, const std::string& what, const json& found) {
  return "\"" + std::string{name} + "\": expected " + what + ", got " + Shown(found);
}

// A length [m], or NaN if the value is none.
double Length(const json& value) {
  const double by = value.is_number() ? value.get<double>() : std::nan("");
  return std::abs(by) <= kMostCraneOrder ? by : std::nan("");
}

OrderReading ReadLength(std::string_view name, const json& value, double sign) {
  const double by = Length(value);
  if (std::isfinite(by)) return Order{LowerCrane{sign * by}};
  return Expected(
      name, "metres, at most " + std::to_string(static_cast<int>(kMostCraneOrder)) + " either way",
      value);
}

OrderReading ReadLower(std::string_view name, const json& value) {
  return ReadLength(name, value, 1);
}

OrderReading ReadRaise(std::string_view name, const json& value) {
  return ReadLength(name, value, -1);
}

OrderReading ReadAttach(std::string_view name, const json& value) {
  if (value == true) return Order{AttachCrane{}};
  return Expected(name, "true", value);
}

OrderReading ReadRelease(std::string_view name, const json& value) {
  if (value == true) return Order{ReleaseCrane{}};
  return Expected(name, "true", value);
}

OrderReading ReadClamp(std::string_view name, const json& value) {
  if (value.is_boolean()) return Order{ClampBase{value.get<bool>()}};
  return Expected(name, "true or false", value);
}

constexpr OrderKey kCraneKeys[] = {
    {"lower", ReadLower}, {"raise", ReadRaise}, {"attach", ReadAttach}, {"release", ReadRelease}};
constexpr OrderKey kClampKeys[] = {{"on", ReadClamp}};

// The body's object, or why there is none.
std::variant<json, std::string> ReadObject(std::string_view body) {
  try {
    json object = json::parse(body);
    if (!object.is_object()) return "the body: expected a JSON object, got " + Shown(object);
    return object;
  } catch (const json::parse_error& error) {
    return "the body is not JSON, see byte " + std::to_string(error.byte);
  } catch (const json::exception&) {
    return std::string{"the body holds a number too large for a double"};
  }
}

// "" when the object has these keys only, else what is wrong.
std::string UnknownKey(const json& object, const std::vector<std::string>& names) {
  for (const auto& item : object.items()) {
    if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
      return "unknown key " + Shown(item.key()) + DidYouMean(item.key(), names);
    }
  }
  return {};
}

// A number within ±most, or NaN if the value is none.
double NumberWithin(const json& value, double most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  return std::abs(number) <= most ? number : std::nan("");
}

// The seconds of an order, 0 where it says none, NaN for what is no time.
double SecondsOf(const json& object) {
  const auto value = object.find("seconds");
  if (value == object.end()) return 0;
  const double seconds = NumberWithin(*value, kMostSeconds);
  return seconds >= 0 ? seconds : std::nan("");
}

OrderReading ReadKeys(const std::string& name, const json& value, double seconds) {
  const auto keys =
      value.is_string() ? RemoteKeys(value.get_ref<const std::string&>()) : std::nullopt;
  if (!keys) return Expected(name, "keys of the remote controller, as in \"L2+B\"", value);
  if (name == "hold") return Order{HoldRemote{*keys}};
  if (name == "release") return Order{ReleaseRemote{*keys}};
  PressRemote press{.keys = *keys};
  if (seconds > 0) press.seconds = seconds;
  return Order{press};
}

OrderReading ReadSticks(const json& value, double seconds) {
  if (!value.is_object() || value.empty()) {
    return Expected("sticks", "an object of lx, ly, rx, ry", value);
  }
  if (std::string why = UnknownKey(value, {"lx", "ly", "rx", "ry"}); !why.empty()) return why;
  MoveSticks sticks{.seconds = seconds};
  const std::pair<const char*, std::optional<double>*> axes[] = {
      {"lx", &sticks.lx}, {"ly", &sticks.ly}, {"rx", &sticks.rx}, {"ry", &sticks.ry}};
  for (const auto& [name, stick] : axes) {
    const auto axis = value.find(name);
    if (axis == value.end()) continue;
    *stick = NumberWithin(*axis, 1);
    if (!std::isfinite(**stick)) return Expected(name, "a number from -1 to 1", *axis);
  }
  return Order{sticks};
}

std::string Listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

OrderReading ReadOneKey(std::span<const OrderKey> keys, std::string_view body) {
  const auto read = ReadObject(body);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);

  std::vector<std::string> names;
  for (const OrderKey& key : keys) names.emplace_back(key.name);
  if (std::string why = UnknownKey(object, names); !why.empty()) return why;
  if (object.size() != 1) {
    return "expected exactly one of " + Listed(names) + ", got " + std::to_string(object.size());
  }
  const auto item = object.begin();
  const auto key = std::find_if(keys.begin(), keys.end(),
                                [&](const OrderKey& k) { return k.name == item.key(); });
  return key->read(key->name, item.value());
}

}  // namespace

OrderReading ReadCraneOrder(std::string_view body) { return ReadOneKey(kCraneKeys, body); }

OrderReading ReadClampOrder(std::string_view body) { return ReadOneKey(kClampKeys, body); }

OrderReading ReadResetOrder(std::string_view body) {
  if (body.empty()) return Order{ResetRobot{}};
  const auto read = ReadObject(body);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  if (object.empty()) return Order{ResetRobot{}};
  return "unknown key " + Shown(object.begin().key()) + ": a reset takes none";
}

OrderReading ReadPushOrder(std::string_view body) {
  const auto read = ReadObject(body);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  if (std::string why = UnknownKey(object, {"body", "force", "seconds"}); !why.empty()) return why;
  PushBody push{.seconds = SecondsOf(object)};
  if (!(push.seconds > 0)) return std::string{"\"seconds\": expected how long it acts"};
  const auto name = object.find("body");
  if (name != object.end()) {
    if (!name->is_string()) return Expected("body", "the name of a body", *name);
    push.body = name->get<std::string>();
  }
  const auto force = object.find("force");
  if (force == object.end() || !force->is_array() || force->size() != 3) {
    return std::string{"\"force\": expected three numbers"};
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = NumberWithin((*force)[i], kMostForce);
    if (!std::isfinite(part)) return Expected("force", "three numbers in N", (*force)[i]);
    push.force[static_cast<Eigen::Index>(i)] = part;
  }
  return Order{push};
}

OrderReading ReadRemoteOrder(std::string_view body) {
  const auto read = ReadObject(body);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  const std::vector<std::string> orders{"press", "hold", "release", "sticks", "on"};
  std::vector<std::string> names = orders;
  names.emplace_back("seconds");
  if (std::string why = UnknownKey(object, names); !why.empty()) return why;
  const double seconds = SecondsOf(object);
  if (!std::isfinite(seconds)) return Expected("seconds", "a time", object["seconds"]);
  const auto given = std::count_if(orders.begin(), orders.end(),
                                   [&](const std::string& name) { return object.contains(name); });
  if (given != 1) {
    return "expected exactly one of " + Listed(orders) + ", got " + std::to_string(given);
  }
  if (const auto on = object.find("on"); on != object.end()) {
    if (!on->is_boolean()) return Expected("on", "true or false", *on);
    return Order{SwitchRemote{on->get<bool>()}};
  }
  if (const auto sticks = object.find("sticks"); sticks != object.end()) {
    return ReadSticks(*sticks, seconds);
  }
  const std::string name = object.contains("press")  ? "press"
                           : object.contains("hold") ? "hold"
                                                     : "release";
  return ReadKeys(name, object.at(name), seconds);
}

}  // namespace understudy
