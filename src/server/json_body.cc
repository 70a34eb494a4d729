#include "server/json_body.h"

#include <algorithm>
#include <cmath>

#include "base/nearest_word.h"

namespace understudy::server {

using nlohmann::json;

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

std::variant<json, std::string> ReadObject(std::string_view body,
                                           const std::vector<std::string>& keys) {
  auto read = ReadObject(body);
  if (const json* object = std::get_if<json>(&read)) {
    if (std::string why = UnknownKey(*object, keys); !why.empty()) return why;
  }
  return read;
}

std::string UnknownKey(const json& object, const std::vector<std::string>& keys) {
  for (const auto& item : object.items()) {
    if (std::find(keys.begin(), keys.end(), item.key()) == keys.end()) {
      return "unknown key " + Shown(item.key()) + DidYouMean(item.key(), keys);
    }
  }
  return {};
}

std::string Expected(std::string_view name, const std::string& what, const json& found) {
  return "\"" + std::string{name} + "\": expected " + what + ", got " + Shown(found);
}

// Of arrays and objects only the kind, for dump recurses and a client chooses how deep.
std::string Shown(const json& value) {
  constexpr std::size_t kLongest = 40;
  if (value.is_structured()) return std::string{"an "} + value.type_name();
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() <= kLongest ? text : text.substr(0, kLongest) + "...";
}

std::string Listed(const std::vector<std::string>& words) {
  std::string list;
  for (const std::string& word : words) list += (list.empty() ? "\"" : ", \"") + word + "\"";
  return list;
}

double NumberWithin(const json& value, double most) {
  const double number = value.is_number() ? value.get<double>() : std::nan("");
  return std::abs(number) <= most ? number : std::nan("");
}

double SecondsOf(const json& object, double most, double otherwise) {
  const auto value = object.find("seconds");
  if (value == object.end()) return otherwise;
  const double seconds = NumberWithin(*value, most);
  return seconds >= 0 ? seconds : std::nan("");
}

std::variant<Eigen::Vector3d, std::string> ReadVector(const json& object, const std::string& key,
                                                      double most, const std::string& what) {
  const auto list = object.find(key);
  if (list == object.end() || !list->is_array() || list->size() != 3) {
    return "\"" + key + "\": expected three numbers";
  }
  Eigen::Vector3d vector;
  for (std::size_t i = 0; i < 3; ++i) {
    const double part = NumberWithin((*list)[i], most);
    if (!std::isfinite(part)) return Expected(key, what, (*list)[i]);
    vector[static_cast<Eigen::Index>(i)] = part;
  }
  return vector;
}

}  // namespace understudy::server
