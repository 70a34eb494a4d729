#include "schema/node.h"

#include <charconv>
#include <cmath>
#include <cstdint>
#include <system_error>

#include "schema/field.h"

namespace understudy::schema {
namespace {

using nlohmann::json;
using Kind = YamlValue::Kind;

// Parses the whole text, independent of the locale. YAML allows a leading plus.
template <class T>
std::optional<T> Parsed(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return std::isfinite(static_cast<double>(value)) ? std::optional(value) : std::nullopt;
}

std::optional<double> Whole(std::optional<double> number) {
  const bool whole = number && std::trunc(*number) == *number && std::abs(*number) <= 0x1p53;
  return whole ? number : std::nullopt;
}

}  // namespace

Node::Node(const YamlValue& value) : yaml(&value) {
  if (value.kind != Kind::kScalar) return;
  text = value.text;
  if (value.quoted) return;
  if (text == "true" || text == "false") flag = text == "true";
  number = Parsed<double>(value.text);
  if (Parsed<std::int64_t>(value.text)) whole = Whole(number);
}

Node::Node(const nlohmann::json& value) : json(&value) {
  if (value.is_string()) text = value.get_ref<const std::string&>();
  if (value.is_boolean()) flag = value.get<bool>();
  if (!value.is_number() || !std::isfinite(value.get<double>())) return;
  number = value.get<double>();
  whole = Whole(number);
}

// Of arrays and objects only the kind: dump() recurses as deep as a client has nested them.
std::string Node::shown() const {
  constexpr std::size_t kLongest = 40;
  if (yaml != nullptr) return Shown(*yaml);
  if (json->is_structured()) return std::string{"an "} + json->type_name();
  if (json->is_number()) return NumberText(json->get<double>());
  const std::string all = json->dump(-1, ' ', false, json::error_handler_t::replace);
  return all.size() <= kLongest ? all : all.substr(0, kLongest) + "...";
}

json JsonOfWord(const std::string& word) {
  if (word == "true" || word == "false") return word == "true";
  if (const auto number = Parsed<double>(word)) return *number;
  return word;
}

json JsonOf(const YamlValue& value) {
  if (value.kind == Kind::kScalar) return value.quoted ? json(value.text) : JsonOfWord(value.text);
  json of;
  if (value.kind == Kind::kSequence) of = json::array();
  if (value.kind == Kind::kMap) of = json::object();
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const json item = JsonOf(value.items[i]);
    if (value.kind == Kind::kMap) of[value.keys[i].text] = item;
    if (value.kind == Kind::kSequence) of.push_back(item);
  }
  return of;
}

}  // namespace understudy::schema
