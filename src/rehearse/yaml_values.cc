#include "rehearse/yaml_values.h"

#include <algorithm>

#include "schema/node.h"

namespace understudy::rehearse {
std::optional<double> NumberOf(const schema::YamlValue& value) {
  return schema::Node(value).number;
}

double SecondsOf(const schema::YamlValue& value, const std::string& key) {
  const schema::Field seconds{.key = key, .unit = "s", .range = {0, kLatestTime}};
  const auto taken = schema::Take(seconds, value);
  if (!taken) Refuse(value, key, schema::Expected(seconds));
  return taken->number;
}

std::string LineOf(const schema::YamlValue& value, const std::string& key, std::size_t most) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; };
  const bool text = value.kind == schema::YamlValue::Kind::kScalar && !value.text.empty() &&
                    std::ranges::none_of(value.text, control);
  if (!text) Refuse(value, key, "a text in one line");
  if (value.text.size() > most) Refuse(value, key, "at most " + std::to_string(most) + " letters");
  return value.text;
}

}  // namespace understudy::rehearse
