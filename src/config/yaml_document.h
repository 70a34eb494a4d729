// A YAML document as a plain tree in which every value knows where it stands.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace understudy::config {

// One value. Anchors, aliases and merge keys (`<<: *name`) are resolved already.
struct YamlValue {
  enum class Kind : std::uint8_t { kNull, kScalar, kSequence, kMap };

  Kind kind = Kind::kNull;
  std::string text;     // of a scalar
  bool quoted = false;  // a quoted scalar is text and never a number
  std::vector<YamlValue> items;
  std::vector<YamlValue> keys;  // of a map: as many as items, scalars, no two alike
  std::string where;            // "go2.yaml:12" or "--set gate.timeout=1"

  // The value of `key` in a map, null where there is none or this is no map.
  const YamlValue* Find(std::string_view key) const;
  YamlValue* Find(std::string_view key) {
    return const_cast<YamlValue*>(std::as_const(*this).Find(key));
  }
};

// The mapping {key: value}, standing where the value stands.
YamlValue MapOf(const std::string& key, YamlValue value);

// Text as it may stand in an error line: cut after 64 letters, control characters shown as dots.
std::string OneLine(const std::string& text);

// What an error line calls a value: 'fast', the quoted text '1', a list, a mapping, nothing.
std::string Shown(const YamlValue& value);

// Reads one document; an empty one is null. `name` starts every `where`, followed by the line
// unless `numbered` is false. Throws ConfigError for what is no YAML, for a key that is given
// twice, a tag, a directive, a second document, a mapping or list as key, an alias that stands for
// itself, for nesting past 32 levels and for more than 20000 values after aliases are resolved.
YamlValue ParseYaml(const std::string& text, const std::string& name, bool numbered = true);

// Reads a file of at most 1 MiB, otherwise as ParseYaml. Throws ConfigError where there is none or
// it cannot be read.
YamlValue ReadYamlFile(const std::filesystem::path& path);

}  // namespace understudy::config
