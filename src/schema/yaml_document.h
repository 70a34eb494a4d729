// Parses a YAML document into a tree whose values know their file and line.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace understudy::schema {

// One value, with anchors, aliases and merge keys (`<<: *name`) resolved.
struct YamlValue {
  enum class Kind : std::uint8_t { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  std::string text;     // of a scalar
  bool quoted = false;  // a quoted scalar is text and never a number
  std::vector<YamlValue> items;
  std::vector<YamlValue> keys;  // of a map: one scalar per item, all different
  std::string where;            // "go2.yaml:12" or "--set gate.timeout=1"

  // Returns the value of `key` in a map, null if there is none or this is not a map.
  const YamlValue* Find(std::string_view key) const;
  YamlValue* Find(std::string_view key) {
    return const_cast<YamlValue*>(std::as_const(*this).Find(key));
  }
};

// Removes a key from a map and returns its value; nullopt if there is none or this is not a map.
std::optional<YamlValue> TakeOut(YamlValue* map, std::string_view key);

// Returns the mapping {key: value}; its `where` is that of the value.
YamlValue MapOf(const std::string& key, YamlValue value);

// Returns text for an error line: cut after 64 letters, with dots for control characters.
std::string OneLine(const std::string& text);

// Describes a value for an error line: 'fast', the quoted text '1', a list, a mapping, nothing.
std::string Shown(const YamlValue& value);

// Parses one document; an empty one is null. Each `where` is `name` and the line, or only `name` if
// `numbered` is false. Throws ConfigError for invalid YAML, a duplicate key, a tag, a directive, a
// second document, a mapping or list as key, an alias inside its own value, more than 32 levels and
// more than 20000 values after resolving aliases.
YamlValue ParseYaml(const std::string& text, const std::string& name, bool numbered = true);

// Parses a file of at most 1 MiB, as ParseYaml does. Throws ConfigError also if the file does not
// exist or cannot be read.
YamlValue ReadYamlFile(const std::filesystem::path& path);

// Returns the names of the YAML files in a folder, without ".yaml", in alphabetical order; none if
// it cannot be read.
std::vector<std::string> YamlNames(const std::filesystem::path& folder);

}  // namespace understudy::schema
