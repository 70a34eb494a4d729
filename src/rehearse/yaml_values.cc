#include "rehearse/yaml_values.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "emulator/request.h"

namespace understudy::rehearse {
namespace {

constexpr double kLatest = 1e6;  // s; *assumed*

}  // namespace

void Refuse(const config::YamlValue& value, const std::string& key, const std::string& what) {
  throw ConfigError(value.where + ": " + key + ": expected " + what + ", got " +
                    config::Shown(value));
}

void RefuseOthers(const config::YamlValue& map, const std::vector<std::string>& known) {
  for (const config::YamlValue& key : map.keys) {
    if (std::ranges::find(known, key.text) != known.end()) continue;
    throw ConfigError(key.where + ": key '" + config::OneLine(key.text) + "': unknown" +
                      DidYouMean(key.text, known));
  }
}

std::optional<double> NumberOf(const config::YamlValue& value) {
  if (value.kind != config::YamlValue::Kind::kScalar || value.quoted) return std::nullopt;
  const nlohmann::json number = emulator::ValueOf(value.text);
  if (!number.is_number()) return std::nullopt;
  return number.get<double>();
}

double SecondsOf(const config::YamlValue& value, const std::string& key) {
  const auto seconds = NumberOf(value);
  if (!seconds || *seconds < 0 || *seconds > kLatest) {
    Refuse(value, key, "seconds from 0 to 1000000");
  }
  return *seconds;
}

std::string LineOf(const config::YamlValue& value, const std::string& key, std::size_t most) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == 0x7f; };
  const bool text = value.kind == config::YamlValue::Kind::kScalar && !value.text.empty() &&
                    std::ranges::none_of(value.text, control);
  if (!text) Refuse(value, key, "a text in one line");
  if (value.text.size() > most) Refuse(value, key, "at most " + std::to_string(most) + " letters");
  return value.text;
}

}  // namespace understudy::rehearse
