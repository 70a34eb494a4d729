#include "schema/yaml_reader.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <system_error>
#include <type_traits>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "base/overloaded.h"

namespace understudy::schema {
namespace {

using Kind = YamlValue::Kind;

// Stores a value that the field takes; returns false if it does not fit.
template <class T>
bool Store(const Taken& taken, T* value) {
  if constexpr (std::is_same_v<T, std::string>) {
    *value = taken.text;
  } else if constexpr (std::is_same_v<T, int>) {
    if (std::abs(taken.number) > std::numeric_limits<int>::max()) return false;
    *value = static_cast<int>(taken.number);
  } else if constexpr (std::is_same_v<T, bool>) {
    *value = taken.number != 0;
  } else {
    *value = taken.number;
  }
  return true;
}

template <class T>
void Read(const Field& field, const YamlValue& value, const std::string& path, T* to) {
  const auto taken = Take(field, value);
  if (taken && Store(*taken, to)) return;
  throw ConfigError(value.where + ": " + path + ": " + Refusal(field, value));
}

// The index of the element that a key selects by index or name.
std::size_t Index(const YamlValue& key, const std::string& path,
                  const std::vector<std::string>& names) {
  std::size_t index = 0;
  const char* const end = key.text.data() + key.text.size();
  const auto [stop, error] = std::from_chars(key.text.data(), end, index);
  const bool numbered = error == std::errc() && stop == end;
  if (numbered && index < names.size()) return index;
  const auto found = std::ranges::find(names, key.text);
  if (found != names.end() && !key.text.empty()) {
    return static_cast<std::size_t>(found - names.begin());
  }
  throw ConfigError(key.where + ": " + path + ": has " + std::to_string(names.size()) +
                    " elements, counted from 0; there is no '" + OneLine(key.text) + "'" +
                    (numbered ? "" : NearestHint(key.text, names)));
}

}  // namespace

void Refuse(const YamlValue& value, const std::string& path, const std::string& what) {
  throw ConfigError(value.where + ": " + path + ": expected " + what + ", got " + Shown(value));
}

void RefuseOthers(const YamlValue& map, const std::vector<std::string>& known,
                  const std::string& path) {
  for (const YamlValue& key : map.keys) {
    if (std::ranges::find(known, key.text) != known.end()) continue;
    throw ConfigError(key.where + ": key '" + path + OneLine(key.text) + "': unknown" +
                      DidYouMean(key.text, known));
  }
}

Mapping::Mapping(const YamlValue& map, std::span<const Field> fields, std::string path)
    : map_(map), fields_(fields), path_(std::move(path)) {
  std::vector<std::string> known;
  for (const Field& field : fields) known.emplace_back(field.key);
  RefuseOthers(map, known, path_);
  for (const Field& field : fields) {
    if (!field.required || map.Find(field.key) != nullptr) continue;
    throw ConfigError(map.where + ": " + path_ + std::string(field.key) + ": missing; expected " +
                      Expected(field));
  }
}

std::optional<Taken> Mapping::Take(std::string_view key) const {
  const YamlValue* value = map_.Find(key);
  if (value == nullptr) return std::nullopt;
  const Field& field = *std::ranges::find(fields_, key, &Field::key);
  const auto taken = schema::Take(field, *value);
  if (taken) return taken;
  throw ConfigError(value->where + ": " + path_ + std::string(key) + ": " + Refusal(field, *value));
}

std::string MarkdownRows(std::span<const Field> fields, const std::string& path) {
  std::string text;
  for (const Field& field : fields) {
    text += "| `" + path + std::string(field.key) + "` | " + Expected(field) + " | " +
            std::string(field.does) + " |\n";
  }
  return text;
}

YamlReader::YamlReader(const YamlValue& root, Places* places) : places_(places) {
  if (root.kind != Kind::kMap && root.kind != Kind::kNull) {
    throw ConfigError(root.where + ": expected keys and values, got " + Shown(root));
  }
  Open(root, "");
}

void YamlReader::Open(const YamlValue& value, const std::string& path) {
  if (value.kind != Kind::kMap && value.kind != Kind::kNull) {
    Refuse(value, path, "a mapping of keys");
  }
  open_.push_back({&value, path.empty() ? "" : path + ".", {}});
}

void YamlReader::RefuseUnknown(const Level& level) const {
  const auto unknown = [&level](const YamlValue& key) {
    return std::ranges::find(level.known, key.text) == level.known.end();
  };
  if (std::ranges::none_of(level.map->keys, unknown)) return;
  RefuseOthers(*level.map, {level.known.begin(), level.known.end()}, level.path);
}

const YamlValue* YamlReader::Ask(const Field& field) {
  Level& level = open_.back();
  level.known.push_back(field.key);
  const YamlValue* value = level.map->Find(field.key);
  if (value != nullptr) (*places_)[Path(field)] = value->where;
  return value;
}

void YamlReader::Visit(const Field& field, const Slot& slot) {
  const YamlValue* value = Ask(field);
  if (value == nullptr) return;
  std::visit(Overloaded{[&](std::optional<double>* to) {
                          if (value->kind == Kind::kNull) return to->reset();
                          Read(field, *value, Path(field), &to->emplace());
                        },
                        [&](std::span<double> to) { ReadList(field, to, *value); },
                        [&]<class T>(std::vector<T>* to) {
                          if (value->kind == Kind::kSequence) to->assign(value->items.size(), {});
                          ReadList(field, std::span(*to), *value);
                        },
                        [&](auto* to) { Read(field, *value, Path(field), to); }},
             slot);
}

template <class Values>
void YamlReader::ReadList(const Field& field, Values list, const YamlValue& value) {
  const std::string path = Path(field);
  const bool numbers = field.type->has_range();
  if (value.kind != Kind::kSequence && !(numbers && value.kind == Kind::kMap)) {
    throw ConfigError(value.where + ": " + path + ": " + Refusal(field, value));
  }
  if (value.kind == Kind::kSequence && value.items.size() != list.size()) {
    throw ConfigError(value.where + ": " + path + ": expected " + std::to_string(list.size()) +
                      " numbers, got " + std::to_string(value.items.size()));
  }
  const Field item = ItemOf(field);
  const std::vector<std::string> unnamed(list.size());
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    const std::size_t index =
        value.kind == Kind::kSequence ? i : Index(value.keys[i], path, unnamed);
    const std::string at = path + "." + std::to_string(index);
    Read(item, value.items[i], at, &list[index]);
    (*places_)[at] = value.items[i].where;
  }
}

void YamlReader::VisitList(const Field& field, const ListSlot& slot) {
  const YamlValue* value = Ask(field);
  if (value == nullptr) return;
  const std::string path = Path(field);
  if (value->kind != Kind::kSequence && value->kind != Kind::kMap) {
    Refuse(*value, path, "a list of mappings");
  }
  if (value->kind == Kind::kSequence) slot.reset(value->items.size());
  std::vector<std::string> names(slot.size());
  for (std::size_t i = 0; i < names.size(); ++i) names[i] = slot.name(i);
  for (std::size_t i = 0; i < value->items.size(); ++i) {
    const std::size_t index =
        value->kind == Kind::kSequence ? i : Index(value->keys[i], path, names);
    const std::string at = path + "." + std::to_string(index);
    (*places_)[at] = value->items[i].where;
    Open(value->items[i], at);
    slot.describe(index);
    Leave();
  }
}

bool YamlReader::Enter(const Field& field, std::string_view scalar_key) {
  const YamlValue* value = Ask(field);
  if (value == nullptr) return false;
  if (value->kind == Kind::kScalar && !scalar_key.empty()) {
    made_.push_back(MapOf(std::string(scalar_key), *value));
    value = &made_.back();
  }
  Open(*value, Path(field));
  return true;
}

void YamlReader::Leave() {
  RefuseUnknown(open_.back());
  open_.pop_back();
}

}  // namespace understudy::schema
