// A value of a YAML document or of JSON, seen alike by those who read fields.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include <nlohmann/json.hpp>

#include "schema/yaml_document.h"

namespace understudy::schema {

// A view of one level of a value, which must outlive it.
struct Node {
  // NOLINTNEXTLINE(google-explicit-constructor): a value is a node
  Node(const YamlValue& value);
  // NOLINTNEXTLINE(google-explicit-constructor)
  Node(const nlohmann::json& value);

  // Returns the value for a message: "'fast'", "\"fast\"", "a list". Shortens long values and
  // replaces invalid UTF-8 of JSON.
  std::string shown() const;

  std::optional<bool> flag{};
  std::optional<double> number{};  // finite; of YAML unquoted, in any locale, also with a plus
  std::optional<double> whole{};   // without a fraction, within ±2^53; 3.0 only of JSON
  std::optional<std::string_view> text{};  // a JSON string, or the letters of any scalar of YAML
  const YamlValue* yaml = nullptr;         // of these two one is not null
  const nlohmann::json* json = nullptr;
};

// Returns the JSON value of a word of a command line or an unquoted scalar of YAML: a number, true,
// false, or text.
nlohmann::json JsonOfWord(const std::string& word);

// Converts YAML to JSON. ParseYaml's limit of depth bounds the recursion.
nlohmann::json JsonOf(const YamlValue& value);

}  // namespace understudy::schema
