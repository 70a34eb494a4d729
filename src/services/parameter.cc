#include "services/parameter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "base/printed.h"

namespace understudy::services {
namespace {

using nlohmann::json;

std::optional<double> Finite(const json& value) {
  if (!value.is_number()) return std::nullopt;
  const double number = value.get<double>();
  return std::isfinite(number) ? std::optional(number) : std::nullopt;
}

// Clamps the value to the field's range, or refuses it, as the field says.
std::optional<double> InRange(const Field& field, double value) {
  if (value >= field.low && value <= field.high) return value;
  if (field.beyond == OutOfRange::kRefuse) return std::nullopt;
  return std::clamp(value, field.low, field.high);
}

std::optional<json> DecodeNumbers(const Field& field, const json& value) {
  if (!value.is_array()) return std::nullopt;
  if (field.count > 0 && value.size() != static_cast<std::size_t>(field.count)) return std::nullopt;
  json numbers = json::array();
  for (const json& element : value) {
    const auto number = Finite(element);
    const auto inside = number ? InRange(field, *number) : std::nullopt;
    if (!inside) return std::nullopt;
    numbers.push_back(*inside);
  }
  return numbers;
}

bool IsPathPoint(const json& point) {
  constexpr std::array kNeeded = {"t_from_start", "x", "y", "yaw"};
  return point.is_object() &&
         std::ranges::all_of(kNeeded, [&](const char* key) { return point.contains(key); }) &&
         std::ranges::all_of(point, [](const json& value) { return Finite(value).has_value(); });
}

std::optional<json> DecodePath(const Field& field, const json& value) {
  if (!value.is_array()) return std::nullopt;
  if (field.count > 0 && value.size() != static_cast<std::size_t>(field.count)) return std::nullopt;
  if (!std::ranges::all_of(value, IsPathPoint)) return std::nullopt;
  return value;
}

std::optional<json> DecodeInt(const Field& field, const json& value) {
  const auto number = Finite(value);
  if (!number || std::trunc(*number) != *number || std::abs(*number) > 9007199254740992.0) {
    return std::nullopt;
  }
  const auto inside = InRange(field, *number);
  if (!inside) return std::nullopt;
  return static_cast<std::int64_t>(*inside);
}

std::optional<json> DecodeField(const Field& field, const json& value) {
  switch (field.kind) {
    case FieldKind::kBool:
      return value.is_boolean() ? std::optional(value) : std::nullopt;
    case FieldKind::kFlag:
      if (value.is_boolean()) return value;
      if (const auto number = Finite(value); number && (*number == 0 || *number == 1)) {
        return *number == 1;
      }
      return std::nullopt;
    case FieldKind::kInt:
      return DecodeInt(field, value);
    case FieldKind::kNumber:
      if (const auto number = Finite(value)) return InRange(field, *number);
      return std::nullopt;
    case FieldKind::kNumbers:
      return DecodeNumbers(field, value);
    case FieldKind::kText:
      return value.is_string() ? std::optional(value) : std::nullopt;
    case FieldKind::kPath:
      return DecodePath(field, value);
  }
  return std::nullopt;
}

const json* Find(const Field& field, const json& object) {
  if (field.key.empty()) return &object;
  if (!object.is_object()) return nullptr;
  for (const std::string_view key : {field.key, field.also}) {
    if (key.empty()) continue;
    if (const auto found = object.find(key); found != object.end()) return &*found;
  }
  return nullptr;
}

// Whether there are too many values, or texts and arrays one in another, to be parsed in time.
bool IsTooMuch(std::string_view text) {
  if (text.size() > kMostParameterBytes) return true;
  std::size_t values = 0;
  bool quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted && c == '\\') ++i;
    if (c == '"') quoted = !quoted;
    if (!quoted && (c == ',' || c == '[' || c == '{')) ++values;
  }
  return values > kMostParameterValues;
}

std::string Shown(double number) { return Printed("%g", number); }

std::string DescribeKind(const Field& field) {
  constexpr std::array kNames = {
      "true or false", "true, false, 0 or 1", "whole number", "number", "numbers",
      "text",          "path points"};
  const std::string name = kNames.at(static_cast<std::size_t>(field.kind));
  return field.count > 0 ? std::to_string(field.count) + " " + name : name;
}

std::string DescribeRange(const Field& field) {
  const bool low = std::isfinite(field.low), high = std::isfinite(field.high);
  if (!low && !high) return "";
  if (!high) return " from " + Shown(field.low);
  return " " + Shown(field.low) + ".." + Shown(field.high) +
         (field.beyond == OutOfRange::kClamp ? " clamped" : "");
}

}  // namespace

std::optional<json> DecodeParameter(std::string_view text, std::span<const Field> fields) {
  json decoded = json::object();
  if (fields.empty()) return decoded;
  if (IsTooMuch(text)) return std::nullopt;
  const bool nothing = text.empty();
  const json given = nothing ? json::object() : json::parse(text, nullptr, false);
  if (given.is_discarded()) return std::nullopt;
  if (!fields.front().key.empty() && !given.is_object()) return std::nullopt;
  for (const Field& field : fields) {
    const json* value = Find(field, given);
    if (value == nullptr) {
      if (field.optional) continue;
      return std::nullopt;
    }
    auto one = DecodeField(field, *value);
    if (!one) return std::nullopt;
    decoded[std::string(field.key)] = *std::move(one);
  }
  return decoded;
}

std::string DescribeFields(std::span<const Field> fields) {
  if (fields.empty()) return "";
  if (fields.front().key.empty()) return DescribeKind(fields.front());
  std::string text;
  for (const Field& field : fields) {
    text += (text.empty() ? "" : ", ") + std::string(field.key);
    if (!field.also.empty()) text += " or " + std::string(field.also);
    text += ": " + DescribeKind(field) + DescribeRange(field) + (field.optional ? ", if any" : "");
  }
  return text;
}

}  // namespace understudy::services
