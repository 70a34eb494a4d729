// Reads the values of a YAML tree into the structs that a Describe function lists.
#pragma once

#include <deque>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "config/archive.h"
#include "config/yaml_document.h"

namespace understudy::config {

// Where each key was read from ("go2.yaml:12"), by its dotted path ("robot.motors.3.slot").
using Places = std::unordered_map<std::string, std::string>;

// A missing key leaves its value unchanged, so several layers can be read into one struct. A list
// replaces the previous list; a mapping from index or name to element changes only those elements
// ({3: {slot: 4}, left_knee_joint: {hold_kp: 80}}). All functions throw ConfigError with place,
// key, what was expected and what was found; the struct may then be partly read.
class Reader : public Archive {
 public:
  // `root` must outlive the reader. Adds what it reads to `places`.
  Reader(const YamlValue& root, Places* places);

  // Call it after the outermost Describe. Throws ConfigError for an unknown top-level key.
  void Finish() { RefuseUnknown(open_.back()); }

 protected:
  void Visit(const Row& row, const Slot& slot) override;
  void VisitList(const Row& row, const ListSlot& slot) override;
  bool Enter(const Row& row, std::string_view scalar_key) override;
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
  const YamlValue* Ask(const Row& row);
  std::string Path(const Row& row) const { return open_.back().path + std::string(row.name); }

  // Reads into `numbers`, the list of `slot`, which has as many elements as the sequence.
  template <class T>
  void ReadNumbers(const Row& row, const Slot& slot, const YamlValue& value, std::span<T> numbers);
  void ReadTexts(const Row& row, std::vector<std::string>* texts, const YamlValue& value);

  Places* places_;
  std::vector<Level> open_;
  std::deque<YamlValue> made_;  // mappings made of scalars, for `scalar_key`
};

}  // namespace understudy::config
