#include "control/order_json.h"

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "robot/nearest_word.h"

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
  for (const auto& item : object.items()) {
    if (std::find(names.begin(), names.end(), item.key()) == names.end()) {
      return "unknown key " + Shown(item.key()) + DidYouMean(item.key(), names);
    }
  }
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

}  // namespace understudy
