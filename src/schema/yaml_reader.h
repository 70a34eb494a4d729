// Reads the values of a YAML tree into the structs that a Describe function lists.
#pragma once

#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "schema/archive.h"

namespace understudy::schema {

// Where each key was read from ("go2.yaml:12"), by its dotted path ("robot.motors.3.slot").
using Places = std::unordered_map<std::string, std::string>;

// A missing key leaves its value unchanged, so several layers can be read into one struct. A list
// replaces the previous list; a mapping from index or name to element changes only those elements
// ({3: {slot: 4}, left_knee_joint: {hold_kp: 80}}). All functions throw ConfigError with place,
// key, what was expected and what was found; the struct may then be partly read.
class YamlReader : public Archive {
 public:
  // `root` must outlive the reader. Adds what it reads to `places`.
  YamlReader(const YamlValue& root, Places* places);

  // Call it after the outermost Describe. Throws ConfigError for an unknown top-level key.
  void Finish() { RefuseUnknown(open_.back()); }

 protected:
  void Visit(const Field& field, const Slot& slot) override;
  void VisitList(const Field& field, const ListSlot& slot) override;
  bool Enter(const Field& field, std::string_view scalar_key) override;
  void Leave() override;

 private:
  struct Level {
    const YamlValue* map;
    std::string path;                     // ends in a dot, "" at the top
    std::vector<std::string_view> known;  // keys visited so far
  };

  void Open(const YamlValue& value, const std::string& path);
  void RefuseUnknown(const Level& level) const;
  // Returns the value of a key of the open mapping, null if it is missing. Records key and place.
  const YamlValue* Ask(const Field& field);
  std::string Path(const Field& field) const { return open_.back().path + std::string(field.key); }

  // Reads into `list`, from a list of as many elements or a mapping from their indices.
  template <class Values>
  void ReadList(const Field& field, Values list, const YamlValue& value);

  Places* places_;
  std::vector<Level> open_;
  std::deque<YamlValue> made_;  // mappings made of scalars, for `scalar_key`
};

// Throws ConfigError: "stand.yaml:3: path: expected what, got 'value'".
[[noreturn]] void Refuse(const YamlValue& value, const std::string& path, const std::string& what);

// Throws ConfigError if the mapping, whose path ends in a dot or is "", has a key that is not
// known, with the nearest of those.
void RefuseOthers(const YamlValue& map, const std::vector<std::string>& known,
                  const std::string& path = {});

// A mapping whose keys are described by fields.
class Mapping {
 public:
  // `path`, which ends in a dot or is "", stands before keys in errors. Throws ConfigError for a
  // key of no field and for one that is required and missing.
  Mapping(const YamlValue& map, std::span<const Field> fields, std::string path = {});

  // Returns the value of a key, nullopt if it is missing. Throws ConfigError if the field of that
  // key does not take it.
  std::optional<Taken> Take(std::string_view key) const;

 private:
  const YamlValue& map_;
  std::span<const Field> fields_;
  std::string path_;
};

// Returns rows of a Markdown table: key, what it takes, meaning.
std::string MarkdownRows(std::span<const Field> fields, const std::string& path = {});

}  // namespace understudy::schema
