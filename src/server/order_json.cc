#include "server/order_json.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "robot/remote_keys.h"
#include "server/json_body.h"

namespace understudy::server {
namespace {

using nlohmann::json;

// One key that a body may hold, and what its value means.
struct OrderKey {
  std::string_view name;
  OrderReading (*read)(std::string_view name, const json& value);
};

// A length [m], or NaN if the value is none.
double Length(const json& value) {
  const double by = value.is_number() ? value.get<double>() : std::nan("");
  return std::abs(by) <= kMostCraneOrder ? by : std::nan("");
}

OrderReading ReadLength(std::string_view name, const json& value, double sign) {
  const double by = Length(value);
  if (std::isfinite(by)) return emulator::Order{emulator::LowerCrane{sign * by}};
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
  if (value == true) return emulator::Order{emulator::AttachCrane{}};
  return Expected(name, "true", value);
}

OrderReading ReadRelease(std::string_view name, const json& value) {
  if (value == true) return emulator::Order{emulator::ReleaseCrane{}};
  return Expected(name, "true", value);
}

OrderReading ReadClamp(std::string_view name, const json& value) {
  if (value.is_boolean()) return emulator::Order{emulator::ClampBase{value.get<bool>()}};
  return Expected(name, "true or false", value);
}

constexpr OrderKey kCraneKeys[] = {
    {"lower", ReadLower}, {"raise", ReadRaise}, {"attach", ReadAttach}, {"release", ReadRelease}};
constexpr OrderKey kClampKeys[] = {{"on", ReadClamp}};

std::optional<std::uint16_t> KeysOf(const json& value) {
  return value.is_string() ? robot::RemoteKeys(value.get_ref<const std::string&>()) : std::nullopt;
}

OrderReading ReadKeys(const std::string& name, const json& value, double seconds) {
  const auto keys = KeysOf(value);
  if (!keys) return Expected(name, "keys of the remote controller, as in \"L2+B\"", value);
  if (name == "hold") return emulator::Order{emulator::HoldRemote{*keys}};
  if (name == "release") return emulator::Order{emulator::ReleaseRemote{*keys}};
  emulator::PressRemote press{.keys = *keys};
  if (seconds > 0) press.seconds = seconds;
  return emulator::Order{press};
}

struct Axis {
  const char* name;
  std::optional<double>* value;
};

// Reads those axes that `object` has; "" or why not.
std::string ReadAxes(const json& object, std::span<const Axis> axes) {
  for (const Axis& axis : axes) {
    const auto found = object.find(axis.name);
    if (found == object.end()) continue;
    *axis.value = NumberWithin(*found, 1);
    if (!std::isfinite(**axis.value)) {
      return Expected(axis.name, "a number from -1 to 1", *found);
    }
  }
  return {};
}

OrderReading ReadSticks(const json& value, double seconds) {
  if (!value.is_object() || value.empty()) {
    return Expected("sticks", "an object of lx, ly, rx, ry", value);
  }
  if (std::string why = UnknownKey(value, {"lx", "ly", "rx", "ry"}); !why.empty()) return why;
  emulator::MoveSticks sticks{.seconds = seconds};
  const Axis axes[] = {
      {"lx", &sticks.lx}, {"ly", &sticks.ly}, {"rx", &sticks.rx}, {"ry", &sticks.ry}};
  if (std::string why = ReadAxes(value, axes); !why.empty()) return why;
  return emulator::Order{sticks};
}

OrderReading ReadSet(const json& value, double seconds) {
  if (!value.is_object()) return Expected("set", "an object of keys, lx, ly, rx, ry", value);
  if (std::string why = UnknownKey(value, {"keys", "lx", "ly", "rx", "ry"}); !why.empty()) {
    return why;
  }
  if (!(seconds > 0)) {
    return std::string{"\"seconds\": expected after how long without another order all is let go"};
  }
  emulator::SetRemote set{.seconds = seconds};
  const json none = "";
  if (const auto keys = value.find("keys"); keys != value.end() && *keys != none) {
    const auto bits = KeysOf(*keys);
    if (!bits) {
      return Expected("keys", "keys of the remote controller, as in \"L2+B\", or \"\"", *keys);
    }
    set.reading.keys = *bits;
  }
  std::optional<double> lx, ly, rx, ry;
  const Axis axes[] = {{"lx", &lx}, {"ly", &ly}, {"rx", &rx}, {"ry", &ry}};
  if (std::string why = ReadAxes(value, axes); !why.empty()) return why;
  set.reading.lx = lx.value_or(0);
  set.reading.ly = ly.value_or(0);
  set.reading.rx = rx.value_or(0);
  set.reading.ry = ry.value_or(0);
  return emulator::Order{set};
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

OrderReading ReadRemoteOrder(std::string_view body) {
  const auto read = ReadObject(body);
  if (const auto* why = std::get_if<std::string>(&read)) return *why;
  const json& object = std::get<json>(read);
  const std::vector<std::string> orders{"press", "hold", "release", "sticks", "set", "on"};
  std::vector<std::string> names = orders;
  names.emplace_back("seconds");
  if (std::string why = UnknownKey(object, names); !why.empty()) return why;
  const double seconds = SecondsOf(object, kMostSeconds);
  if (!std::isfinite(seconds)) return Expected("seconds", "a time", object["seconds"]);
  const auto given = std::count_if(orders.begin(), orders.end(),
                                   [&](const std::string& name) { return object.contains(name); });
  if (given != 1) {
    return "expected exactly one of " + Listed(orders) + ", got " + std::to_string(given);
  }
  for (const char* lasting : {"hold", "release", "on"}) {
    if (object.contains(lasting) && object.contains("seconds")) {
      return "\"seconds\": \"" + std::string{lasting} + "\" lasts until another order";
    }
  }
  if (const auto on = object.find("on"); on != object.end()) {
    if (!on->is_boolean()) return Expected("on", "true or false", *on);
    return emulator::Order{emulator::SwitchRemote{on->get<bool>()}};
  }
  if (const auto sticks = object.find("sticks"); sticks != object.end()) {
    return ReadSticks(*sticks, seconds);
  }
  if (const auto set = object.find("set"); set != object.end()) return ReadSet(*set, seconds);
  const std::string name = object.contains("press")  ? "press"
                           : object.contains("hold") ? "hold"
                                                     : "release";
  return ReadKeys(name, object.at(name), seconds);
}

}  // namespace understudy::server
