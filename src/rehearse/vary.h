// How the runs of a campaign differ: `vary` of a scenario (docs/rehearsing.md).
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "schema/yaml_document.h"

namespace understudy::rehearse {

// What a run has for a varied key, as YAML writes the value in one line: 0.35, [1, 2], '1.3'.
struct Setting {
  std::string key;
  std::string text;

  bool operator==(const Setting&) const = default;
};

// Returns "robot=go2 terrain.friction=0.35".
std::string SettingsText(const std::vector<Setting>& settings);

// Reports show as many values of a key apart, more numbers by parts of their range;
// *assumed*.
inline constexpr std::size_t kMostGroups = 12;

// A varied key: one of the scenario (kVariedKeys of with_settings.h), one of the configuration as
// --set takes it, or
// "$name", which stands for its value wherever the scenario has it.
struct Axis {
  std::string key{};
  std::string where{};                // "friction.yaml:9"
  std::vector<std::string> values{};  // the texts to choose from; empty: a range
  double low = 0, high = 0;           // of a range, both included
  bool whole = false;                 // only whole numbers of it

  bool is_range() const { return values.empty(); }
};

// Whether a key is "$name".
bool IsPlaceholder(std::string_view key);

// The runs of a campaign, numbered from 1: each combination of the grid and of the rows of the list
// with each draw. What a run has depends on nothing but the plan and the run's number, so shards
// agree on it; every combination meets the same draws, so that combinations compare.
class Plan {
 public:
  // Reads `vary`. Throws ConfigError with file, line, key, what was expected and the nearest word.
  explicit Plan(const schema::YamlValue& vary);

  std::size_t size() const { return size_; }
  // In the order of axes(). `run` is from 1 to size().
  std::vector<Setting> Of(std::size_t run) const;
  const std::vector<Axis>& axes() const { return axes_; }

  // Returns runs that have, of every key, each listed value and the least and the greatest of a
  // range; ascending. Where these can be played, those that differ by values alone can, too.
  std::vector<std::size_t> Samples() const;

 private:
  void ReadGrid(const schema::YamlValue& map);
  void ReadList(const schema::YamlValue& list);
  void ReadDrawn(const schema::YamlValue& map, bool latin, std::size_t runs, int seed);
  void Add(Axis axis);

  std::vector<Axis> axes_;
  std::size_t of_grid_ = 0, of_list_ = 0;         // axes, which come first; the others are drawn
  std::vector<std::vector<std::string>> points_;  // values of the grid's axes
  std::vector<std::vector<std::string>> rows_;    // of the list, by axis
  std::vector<std::vector<std::string>> draws_;   // by axis
  std::size_t size_ = 1;
};

// Returns a value as YAML writes it in one line.
std::string FlowText(const schema::YamlValue& value);

// Returns the keys of `vary` as rows of Markdown's table of scenario keys.
std::string VaryReference();

}  // namespace understudy::rehearse
