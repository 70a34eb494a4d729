#include "rehearse/vary.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>
#include <string_view>

#include "base/errors.h"
#include "base/printed.h"
#include "rehearse/yaml_values.h"
#include "robot/randomization.h"

namespace understudy::rehearse {
namespace {

using schema::YamlValue;
using Kind = YamlValue::Kind;

// All *assumed*.
constexpr std::size_t kMostRuns = 1'000'000;
constexpr std::size_t kMostValues = 10'000;  // of a key
constexpr std::size_t kLongestValue = 400;   // letters
constexpr double kMostSeed = std::numeric_limits<int>::max();

using schema::Field;
using schema::kTree;
using schema::kWhole;

constexpr std::string_view kAxes = "a mapping of keys to values";
constexpr Field kVaryKeys[] = {
    {"grid", &kTree, "", {}, "Every combination; of a range `count` values", kAxes},
    {"list", &kTree, "", {}, "These runs, all with the same keys", "a list of mappings"},
    {"random", &kTree, "", {}, "Drawn by `seed`, `runs` times, each key on its own", kAxes},
    {"latin",
     &kTree,
     "",
     {},
     "Drawn as a Latin hypercube: each key's range is cut into `runs` parts, and each part is met "
     "once",
     kAxes},
    {"runs", &kWhole, "", {1, kMostRuns}, "Draws of `random` or `latin`; needed with them"},
    {"seed", &kWhole, "", {0, kMostSeed}, "Of these draws; 1 unless given"},
};
constexpr Field kRangeKeys[] = {
    {.key = "from", .required = true},
    {.key = "to", .required = true},
    {"count", &kWhole, "", {1, kMostValues}},
    {"whole", &schema::kSwitch},
};

// Six digits, so that the line that repeats a run has all of the value.
std::string Written(double number) { return Printed("%.6g", number); }
std::string Written(double number, bool whole) {
  if (!whole) return Written(number);
  return std::to_string(std::llround(number));
}

// At which of `count` equal steps from low to high.
std::string PointOf(const Axis& axis, std::size_t i, std::size_t count) {
  if (count == 1) return Written(axis.low, axis.whole);
  const double share = static_cast<double>(i) / static_cast<double>(count - 1);
  return Written(axis.low + share * (axis.high - axis.low), axis.whole);
}

// The value that a share [0, 1) of an axis stands for.
std::string ValueAt(const Axis& axis, double share) {
  if (!axis.is_range()) {
    const auto place = share * static_cast<double>(axis.values.size());
    return axis.values[std::min(static_cast<std::size_t>(place), axis.values.size() - 1)];
  }
  if (!axis.whole) return Written(axis.low + share * (axis.high - axis.low));
  const double number = axis.low + std::floor(share * (axis.high - axis.low + 1));
  return Written(std::min(number, axis.high), true);
}

std::string ValueText(const YamlValue& value, const std::string& key) {
  std::string text = FlowText(value);
  if (text.size() > kLongestValue) {
    Refuse(value, key, "at most " + std::to_string(kLongestValue) + " letters");
  }
  return text;
}

// Reads the values of a key: a list, or a range. `count` gets the steps of a range in a grid.
Axis AxisOf(const YamlValue& key, const YamlValue& value, std::optional<std::size_t>* count) {
  Axis axis{.key = key.text, .where = key.where};
  const bool range = value.kind == Kind::kMap && value.Find("from") != nullptr;
  if (!range) {
    if (value.kind != Kind::kSequence || value.items.empty()) {
      Refuse(value, key.text, "a list of values, or a range, as in {from: 0.3, to: 1}");
    }
    if (value.items.size() > kMostValues) {
      Refuse(value, key.text, "at most " + std::to_string(kMostValues) + " values");
    }
    for (const YamlValue& item : value.items) {
      std::string text = ValueText(item, key.text);
      if (std::ranges::find(axis.values, text) != axis.values.end()) {
        throw ConfigError(item.where + ": " + key.text + ": " + text + " is there twice");
      }
      axis.values.push_back(std::move(text));
    }
    return axis;
  }
  const schema::Mapping keys(value, kRangeKeys, key.text + ".");
  axis.low = keys.Take("from")->number;
  axis.high = keys.Take("to")->number;
  if (axis.high < axis.low) {
    throw ConfigError(value.Find("to")->where + ": " + key.text + ".to: is less than from");
  }
  axis.whole = key.text == "seed" || key.text.ends_with(".seed");  // no other number is a seed
  if (const auto whole = keys.Take("whole")) axis.whole = whole->number != 0;
  constexpr double kGreatestWhole = 0x1p53;
  const bool has_whole_bounds =
      axis.low == std::floor(axis.low) && axis.high == std::floor(axis.high) &&
      std::abs(axis.low) <= kGreatestWhole && std::abs(axis.high) <= kGreatestWhole;
  if (axis.whole && !has_whole_bounds) Refuse(value, key.text, "whole numbers from and to");
  if (const auto steps = keys.Take("count")) *count = static_cast<std::size_t>(steps->number);
  return axis;
}

// A drawn order of the numbers below `count`, by the axis.
std::vector<std::size_t> Shuffled(std::size_t count, const std::string& key, int seed) {
  std::vector<std::pair<double, std::size_t>> places;
  robot::Randomizer randomizer(seed);
  for (std::size_t i = 0; i < count; ++i) {
    places.emplace_back(randomizer.Draw(key, "place " + std::to_string(i), 0, 1), i);
  }
  std::ranges::sort(places);
  std::vector<std::size_t> order;
  order.reserve(count);
  for (const auto& [place, number] : places) order.push_back(number);
  return order;
}

}  // namespace

bool IsPlaceholder(std::string_view key) {
  constexpr std::string_view kLetters =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_";
  return key.size() > 1 && key.front() == '$' && (key[1] < '0' || key[1] > '9') &&
         key.find_first_not_of(kLetters, 1) == std::string_view::npos;
}

std::string SettingsText(const std::vector<Setting>& settings) {
  std::string text;
  for (const Setting& one : settings) text += (text.empty() ? "" : " ") + one.key + "=" + one.text;
  return text;
}

std::string FlowText(const YamlValue& value) {
  if (value.kind == Kind::kNull) return "null";
  if (value.kind == Kind::kScalar) {
    constexpr std::string_view kPlain =
        "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_./+-";
    const bool plain = !value.quoted && !value.text.empty() &&
                       value.text.find_first_not_of(kPlain) == std::string::npos;
    if (plain) return value.text;
    std::string text = "'";
    for (const char c : value.text) text += c == '\'' ? std::string("''") : std::string(1, c);
    return text + "'";
  }
  const bool map = value.kind == Kind::kMap;
  std::string text;
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    if (i > 0) text += ", ";
    if (map) text += FlowText(value.keys[i]) + ": ";
    text += FlowText(value.items[i]);
  }
  return map ? "{" + text + "}" : "[" + text + "]";
}

Plan::Plan(const YamlValue& vary) {
  if (vary.kind != Kind::kMap) {
    Refuse(vary, "vary", "a mapping, as in {grid: {terrain.friction: [0.3, 0.6, 0.9]}}");
  }
  const schema::Mapping keys(vary, kVaryKeys, "vary.");
  const YamlValue* random = vary.Find("random");
  const YamlValue* latin = vary.Find("latin");
  if (random != nullptr && latin != nullptr) {
    throw ConfigError(latin->where + ": vary.latin: not beside random; draw all keys in one way");
  }
  if (const YamlValue* grid = vary.Find("grid")) ReadGrid(*grid);
  of_grid_ = axes_.size();
  if (const YamlValue* list = vary.Find("list")) ReadList(*list);
  of_list_ = axes_.size() - of_grid_;
  const YamlValue* drawn = random != nullptr ? random : latin;
  const YamlValue* runs = vary.Find("runs");
  const YamlValue* seed = vary.Find("seed");
  if (drawn == nullptr) {
    const YamlValue* lone = runs != nullptr ? runs : seed;
    if (lone != nullptr) {
      throw ConfigError(lone->where + ": vary." + (runs != nullptr ? "runs" : "seed") +
                        ": only beside random or latin");
    }
  } else {
    if (runs == nullptr) throw ConfigError(drawn->where + ": vary.runs: missing; how many draws?");
    ReadDrawn(*drawn, latin != nullptr, static_cast<std::size_t>(keys.Take("runs")->number),
              static_cast<int>(keys.Take("seed").value_or(schema::Taken{1}).number));
  }
  if (axes_.empty()) {
    throw ConfigError(vary.where + ": vary: expected one of grid, list, random, latin");
  }
  if (size_ > kMostRuns) {
    throw ConfigError(vary.where + ": vary: " + std::to_string(size_) + " runs; at most " +
                      std::to_string(kMostRuns));
  }
}

void Plan::Add(Axis axis) {
  if (axis.key.empty() || (axis.key.front() == '$' && !IsPlaceholder(axis.key))) {
    throw ConfigError(axis.where +
                      ": vary: expected a key, or $ and a name of letters, digits and _, got '" +
                      schema::OneLine(axis.key) + "'");
  }
  const auto same = std::ranges::find(axes_, axis.key, &Axis::key);
  if (same != axes_.end()) {
    throw ConfigError(axis.where + ": vary: " + axis.key + " varies already at " + same->where);
  }
  axes_.push_back(std::move(axis));
}

void Plan::ReadGrid(const YamlValue& map) {
  if (map.kind != Kind::kMap || map.items.empty()) {
    Refuse(map, "vary.grid", "a mapping of keys to values");
  }
  for (std::size_t i = 0; i < map.items.size(); ++i) {
    std::optional<std::size_t> count;
    Axis axis = AxisOf(map.keys[i], map.items[i], &count);
    std::vector<std::string> points = axis.values;
    if (axis.is_range()) {
      const double span = axis.high - axis.low + 1;
      if (!count && axis.whole && span <= static_cast<double>(kMostValues)) {
        count = static_cast<std::size_t>(span);
      }
      if (!count) {
        throw ConfigError(map.items[i].where + ": " + axis.key +
                          ".count: missing; into how many values?");
      }
      for (std::size_t j = 0; j < *count; ++j) {
        std::string point = PointOf(axis, j, *count);
        if (points.empty() || points.back() != point) points.push_back(std::move(point));
      }
    }
    if (points.size() <= kMostGroups) axis.values = points;
    size_ = std::min(size_ * points.size(), kMostRuns + 1);
    Add(std::move(axis));
    points_.push_back(std::move(points));
  }
}

void Plan::ReadList(const YamlValue& list) {
  if (list.kind != Kind::kSequence || list.items.empty()) {
    Refuse(list, "vary.list", "a list of mappings, as in [{robot: go2}, {robot: b2}]");
  }
  const std::size_t first = axes_.size();
  for (const YamlValue& row : list.items) {
    if (row.kind != Kind::kMap || row.items.empty()) {
      Refuse(row, "vary.list", "a mapping of keys to values, as in {robot: go2}");
    }
    if (&row == &list.items.front()) {
      for (const YamlValue& key : row.keys) Add({.key = key.text, .where = key.where});
    }
    std::vector<std::string> known;
    std::vector<std::string> values;
    for (std::size_t i = first; i < axes_.size(); ++i) known.push_back(axes_[i].key);
    RefuseOthers(row, known);
    for (std::size_t i = first; i < axes_.size(); ++i) {
      const YamlValue* value = row.Find(axes_[i].key);
      if (value == nullptr) {
        throw ConfigError(row.where + ": vary.list: " + axes_[i].key +
                          ": missing; the rows before have it");
      }
      values.push_back(ValueText(*value, axes_[i].key));
      std::vector<std::string>& all = axes_[i].values;
      if (std::ranges::find(all, values.back()) == all.end()) all.push_back(values.back());
    }
    rows_.push_back(std::move(values));
  }
  size_ = std::min(size_ * rows_.size(), kMostRuns + 1);
}

void Plan::ReadDrawn(const YamlValue& map, bool latin, std::size_t runs, int seed) {
  if (map.kind != Kind::kMap || map.items.empty()) {
    Refuse(map, latin ? "vary.latin" : "vary.random", "a mapping of keys to values");
  }
  size_ = std::min(size_ * runs, kMostRuns + 1);
  if (size_ > kMostRuns) return;
  draws_.resize(runs);
  for (std::size_t i = 0; i < map.items.size(); ++i) {
    std::optional<std::size_t> count;
    Axis axis = AxisOf(map.keys[i], map.items[i], &count);
    if (count) {
      throw ConfigError(map.items[i].Find("count")->where + ": " + axis.key +
                        ".count: only in a grid");
    }
    const std::vector<std::size_t> order =
        latin ? Shuffled(runs, axis.key, seed) : std::vector<std::size_t>();
    robot::Randomizer randomizer(seed);
    for (std::size_t j = 0; j < runs; ++j) {
      double share = randomizer.Draw(axis.key, std::to_string(j), 0, 1);
      if (latin) share = (static_cast<double>(order[j]) + share) / static_cast<double>(runs);
      draws_[j].push_back(ValueAt(axis, share));
    }
    Add(std::move(axis));
  }
}

std::vector<Setting> Plan::Of(std::size_t run) const {
  std::size_t rest = run - 1;
  std::vector<Setting> settings(axes_.size());
  const auto set = [&](std::size_t axis, const std::string& text) {
    settings[axis] = {.key = axes_[axis].key, .text = text};
  };
  const auto take = [&rest](const auto& rows) -> const auto& {
    const auto& row = rows[rest % rows.size()];
    rest /= rows.size();
    return row;
  };
  const std::size_t fixed = of_grid_ + of_list_;
  if (!draws_.empty()) {
    const std::vector<std::string>& draw = take(draws_);
    for (std::size_t i = 0; i < draw.size(); ++i) set(fixed + i, draw[i]);
  }
  if (!rows_.empty()) {
    const std::vector<std::string>& row = take(rows_);
    for (std::size_t i = 0; i < row.size(); ++i) set(of_grid_ + i, row[i]);
  }
  for (std::size_t i = of_grid_; i-- > 0;) set(i, take(points_[i]));
  return settings;
}

std::vector<std::size_t> Plan::Samples() const {
  std::set<std::size_t> samples;
  std::vector<std::set<std::string>> seen(axes_.size());
  std::vector<std::pair<std::size_t, double>> least(axes_.size()), most(axes_.size());
  for (std::size_t run = 1; run <= size_; ++run) {
    const std::vector<Setting> settings = Of(run);
    for (std::size_t i = 0; i < axes_.size(); ++i) {
      if (!axes_[i].is_range()) {
        if (seen[i].insert(settings[i].text).second) samples.insert(run);
        continue;
      }
      const double value = std::stod(settings[i].text);
      if (least[i].first == 0 || value < least[i].second) least[i] = {run, value};
      if (most[i].first == 0 || value > most[i].second) most[i] = {run, value};
    }
  }
  for (std::size_t i = 0; i < axes_.size(); ++i) {
    if (axes_[i].is_range()) samples.insert({least[i].first, most[i].first});
  }
  return {samples.begin(), samples.end()};
}

std::string VaryReference() { return schema::MarkdownRows(kVaryKeys, "vary."); }

}  // namespace understudy::rehearse
