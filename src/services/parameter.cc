#include "services/parameter.h"

#include <algorithm>
#include <array>
#include <string>

namespace understudy::services {
namespace {

using nlohmann::json;

using schema::Node;
using schema::Taken;
using schema::Type;

std::optional<Taken> TakeBool(const Field&, const Node& node) {
  const auto flag = node.flag;
  return flag ? std::optional(Taken{*flag ? 1.0 : 0.0}) : std::nullopt;
}

std::optional<Taken> TakeFlag(const Field& field, const Node& node) {
  const std::optional<double> number = node.number;
  const bool is_flag = number && (*number == 0 || *number == 1);
  return is_flag ? std::optional(Taken{*number}) : TakeBool(field, node);
}

std::optional<Taken> TakeString(const Field&, const Node& node) {
  const auto text = node.text;
  return text ? std::optional(Taken{0, *text}) : std::nullopt;
}

std::optional<Taken> TakePoint(const Field&, const Node& node) {
  constexpr std::array kNeeded = {"t_from_start", "x", "y", "yaw"};
  const json* const point = node.json;
  const auto has = [&](const char* key) { return point->contains(key); };
  const auto finite = [](const json& value) { return Node(value).number.has_value(); };
  const bool is = point != nullptr && point->is_object() && std::ranges::all_of(kNeeded, has) &&
                  std::ranges::all_of(*point, finite);
  return is ? std::optional(Taken{}) : std::nullopt;
}

json FlagJson(const Field&, const Taken& taken) { return taken.number != 0; }

const Type kPoint{"point", "", "", schema::Form::kOther, TakePoint};

std::optional<json> DecodeField(const Field& field, const json& value) {
  if (!field.is_list()) {
    const auto taken = Take(field, value);
    return taken ? std::optional(JsonOf(field, *taken)) : std::nullopt;
  }
  if (!value.is_array() || (field.count > 0 && value.size() != field.count)) return std::nullopt;
  const Field item = ItemOf(field);
  json list = json::array();
  for (const json& element : value) {
    const auto taken = Take(item, element);
    if (!taken) return std::nullopt;
    list.push_back(item.type == &kPoint ? element : JsonOf(item, *taken));
  }
  return list;
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

}  // namespace

const Type kBool{"bool", "true or false", "", schema::Form::kOther, TakeBool, FlagJson};
const Type kFlag{"flag", "true, false, 0 or 1", "", schema::Form::kOther, TakeFlag, FlagJson};
const Type kString{"text", "text", "", schema::Form::kText, TakeString};
const Type kPath{"path", "a list of path points", "", schema::Form::kOther, nullptr, nullptr,
                 &kPoint};

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
      if (field.required) return std::nullopt;
      continue;
    }
    auto one = DecodeField(field, *value);
    if (!one) return std::nullopt;
    decoded[std::string(field.key)] = *std::move(one);
  }
  return decoded;
}

std::string DescribeFields(std::span<const Field> fields) {
  if (fields.empty()) return "";
  if (fields.front().key.empty()) return schema::Expected(fields.front());
  std::string text;
  for (const Field& field : fields) {
    text += (text.empty() ? "" : "; ") + std::string(field.key);
    if (!field.also.empty()) text += " or " + std::string(field.also);
    text += ": " + schema::Expected(field) + (field.clamped ? ", clamped" : "") +
            (field.required ? "" : ", if any");
  }
  return text;
}

}  // namespace understudy::services
