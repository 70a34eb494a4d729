// Puts the values of a YAML tree into the structs that a Describe function lists.
#pragma once

#include <deque>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/archive.h"
#include "config/yaml_document.h"

namespace understudy::config {

// Where each key that has been read stands, by its dotted path ("robot.motors.3.slot").
using Places = std::map<std::string, std::string>;

// A key that is missing leaves its value as it is, so layers are read one after the other into the
// same struct. A list replaces the list before it; a mapping from index or name to element changes
// those elements only ({3: {slot: 4}, left_knee_joint: {hold_kp: 80}}). Every step throws
// ConfigError with place, key, what was expected and what was found; the struct may then be half
// read.
class Reader : public Archive {
 public:
  // `root` must outlive the reader; `places` is added to.
  Reader(const YamlValue& root, Places* places);

  // To be called after the outermost Describe: throws for a top-level key nobody asked for.
  void Finish() { RefuseUnknown(open_.back()); }

 protected:
  void Visit(const Row& row, const Slot& slot) override;
  void VisitList(const Row& row, const ListSlot& slot) override;
  bool Enter(const Row& row, std::string_view scalar_key) override;
  void Leave() override;

 private:
  struct Level {
    const YamlValue* map;
    std::string path;                // with the dot that the next key follows
    std::vector<std::string> known;  // keys asked for so far
  };

  void Open(const YamlValue& value, const std::string& path);
  void RefuseUnknown(const Level& level) const;
  // The value of a key of the open mapping, null where it is missing. Notes key and place.
  const YamlValue* Ask(const Row& row);
  std::string Path(const Row& row) const { return open_.back().path + std::string(row.name); }

  // Into `numbers`, the list of `slot`; a sequence has as many.
  template <class T>
  void ReadNumbers(const Row& row, const Slot& slot, const YamlValue& value, std::span<T> numbers);
  void ReadTexts(const Row& row, std::vector<std::string>* texts, const YamlValue& value);

  Places* places_;
  std::vector<Level> open_;
  std::deque<YamlValue> made_;  // mappings that a bare word stood for
};

}  // namespace understudy::config
