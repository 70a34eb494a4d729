#include "config/reader.h"

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

namespace understudy::config {
namespace {

using Kind = YamlValue::Kind;

// Parses the whole token as a number, independent of the locale. YAML allows a leading plus.
template <class T>
std::optional<T> Parsed(std::string_view text) {
  if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

template <class T>
bool ReadNumber(const Row& row, const YamlValue& value, T* number) {
  if (value.kind != Kind::kScalar || value.quoted) return false;
  const std::optional<T> parsed = Parsed<T>(value.text);
  if (!parsed) return false;
  const double real = static_cast<double>(*parsed);
  if (!std::isfinite(real) || real < row.range.min || real > row.range.max) return false;
  *number = *parsed;
  return true;
}

bool ReadOptional(const Row& row, const YamlValue& value, std::optional<double>* number) {
  if (value.kind != Kind::kNull) return ReadNumber(row, value, &number->emplace());
  number->reset();
  return true;
}

bool ReadText(const YamlValue& value, std::string* text) {
  const auto control = [](char c) { return static_cast<unsigned char>(c) < ' ' || c == '\x7f'; };
  if (value.kind != Kind::kScalar) return false;
  if (std::any_of(value.text.begin(), value.text.end(), control)) return false;
  *text = value.text;
  return true;
}

bool ReadBool(const YamlValue& value, bool* flag) {
  if (value.kind != Kind::kScalar || value.quoted) return false;
  if (value.text != "true" && value.text != "false") return false;
  *flag = value.text == "true";
  return true;
}

bool ReadWord(const YamlValue& value, const WordSlot& slot) {
  if (value.kind != Kind::kScalar) return false;
  const auto found = std::find(slot.words.begin(), slot.words.end(), value.text);
  if (found == slot.words.end()) return false;
  *slot.index = static_cast<int>(found - slot.words.begin());
  return true;
}

[[noreturn]] void FailValue(const YamlValue& value, const std::string& path,
                            const std::string& expected) {
  throw ConfigError(value.where + ": " + path + ": expected " + expected + ", got " + Shown(value));
}

// The index of the element that a key selects by index or name.
std::size_t Index(const YamlValue& key, const std::string& path,
                  const std::vector<std::string>& names) {
  const std::optional<std::size_t> index = Parsed<std::size_t>(key.text);
  if (index && *index < names.size()) return *index;
  const auto found = std::find(names.begin(), names.end(), key.text);
  if (found != names.end() && !key.text.empty()) {
    return static_cast<std::size_t>(found - names.begin());
  }
  throw ConfigError(key.where + ": " + path + ": has " + std::to_string(names.size()) +
                    " elements, counted from 0; there is no '" + OneLine(key.text) + "'" +
                    (index ? "" : NearestHint(key.text, names)));
}

}  // namespace

Reader::Reader(const YamlValue& root, Places* places) : places_(places) {
  if (root.kind != Kind::kMap && root.kind != Kind::kNull) {
    throw ConfigError(root.where + ": expected keys and values, got " + Shown(root));
  }
  Open(root, "");
}

void Reader::Open(const YamlValue& value, const std::string& path) {
  if (value.kind != Kind::kMap && value.kind != Kind::kNull) {
    FailValue(value, path, "a mapping of keys");
  }
  open_.push_back({&value, path.empty() ? "" : path + ".", {}});
}

void Reader::RefuseUnknown(const Level& level) const {
  for (const YamlValue& key : level.map->keys) {
    if (std::find(level.known.begin(), level.known.end(), key.text) != level.known.end()) continue;
    throw ConfigError(key.where + ": key '" + level.path + OneLine(key.text) + "': unknown" +
                      DidYouMean(key.text, {level.known.begin(), level.known.end()}));
  }
}

const YamlValue* Reader::Ask(const Row& row) {
  Level& level = open_.back();
  level.known.push_back(row.name);
  const YamlValue* value = level.map->Find(row.name);
  if (value != nullptr) (*places_)[Path(row)] = value->where;
  return value;
}

void Reader::Visit(const Row& row, const Slot& slot) {
  const YamlValue* value = Ask(row);
  if (value == nullptr) return;
  const auto read_list = [&](auto* list) {
    if (value->kind == Kind::kSequence) list->assign(value->items.size(), 0);
    ReadNumbers(row, slot, *value, std::span(*list));
  };
  if (const auto* reals = std::get_if<std::vector<double>*>(&slot)) return read_list(*reals);
  if (const auto* wholes = std::get_if<std::vector<int>*>(&slot)) return read_list(*wholes);
  if (const auto* reals = std::get_if<std::span<double>>(&slot)) {
    return ReadNumbers(row, slot, *value, *reals);
  }
  if (const auto* texts = std::get_if<std::vector<std::string>*>(&slot)) {
    return ReadTexts(row, *texts, *value);
  }
  bool read = false;
  if (const auto* flag = std::get_if<bool*>(&slot)) read = ReadBool(*value, *flag);
  if (const auto* whole = std::get_if<int*>(&slot)) read = ReadNumber(row, *value, *whole);
  if (const auto* real = std::get_if<double*>(&slot)) read = ReadNumber(row, *value, *real);
  if (const auto* maybe = std::get_if<std::optional<double>*>(&slot)) {
    read = ReadOptional(row, *value, *maybe);
  }
  if (const auto* text = std::get_if<std::string*>(&slot)) read = ReadText(*value, *text);
  const auto* word = std::get_if<WordSlot>(&slot);
  if (word != nullptr) read = ReadWord(*value, *word);
  if (read) return;
  const bool misspelt = word != nullptr && value->kind == Kind::kScalar;
  const std::string hint = misspelt ? NearestHint(value->text, word->words) : "";
  throw ConfigError(value->where + ": " + Path(row) + ": expected " + Expected(row, slot) +
                    ", got " + Shown(*value) + hint);
}

template <class T>
void Reader::ReadNumbers(const Row& row, const Slot& slot, const YamlValue& value,
                         std::span<T> numbers) {
  const std::string path = Path(row);
  const auto read = [&](const YamlValue& item, std::size_t i, T* number) {
    const std::string at = path + "." + std::to_string(i);
    if (!ReadNumber(row, item, number)) FailValue(item, at, Expected(row, number));
    (*places_)[at] = item.where;
  };
  if (value.kind == Kind::kMap) {
    for (std::size_t i = 0; i < value.keys.size(); ++i) {
      const std::vector<std::string> unnamed(numbers.size());
      const std::size_t index = Index(value.keys[i], path, unnamed);
      read(value.items[i], index, &numbers[index]);
    }
    return;
  }
  if (value.kind != Kind::kSequence) FailValue(value, path, Expected(row, slot));
  if (value.items.size() != numbers.size()) {
    throw ConfigError(value.where + ": " + path + ": expected " + std::to_string(numbers.size()) +
                      " numbers, got " + std::to_string(value.items.size()));
  }
  for (std::size_t i = 0; i < numbers.size(); ++i) read(value.items[i], i, &numbers[i]);
}

void Reader::ReadTexts(const Row& row, std::vector<std::string>* texts, const YamlValue& value) {
  const std::string path = Path(row);
  if (value.kind != Kind::kSequence) FailValue(value, path, Expected(row, texts));
  texts->assign(value.items.size(), "");
  for (std::size_t i = 0; i < value.items.size(); ++i) {
    std::string* text = &(*texts)[i];
    if (!ReadText(value.items[i], text)) {
      FailValue(value.items[i], path + "." + std::to_string(i), Expected(row, text));
    }
  }
}

void Reader::VisitList(const Row& row, const ListSlot& slot) {
  const YamlValue* value = Ask(row);
  if (value == nullptr) return;
  const std::string path = Path(row);
  if (value->kind != Kind::kSequence && value->kind != Kind::kMap) {
    FailValue(*value, path, "a list of mappings");
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

bool Reader::Enter(const Row& row, std::string_view scalar_key) {
  const YamlValue* value = Ask(row);
  if (value == nullptr) return false;
  if (value->kind == Kind::kScalar && !scalar_key.empty()) {
    made_.push_back(MapOf(std::string(scalar_key), *value));
    value = &made_.back();
  }
  Open(*value, Path(row));
  return true;
}

void Reader::Leave() {
  RefuseUnknown(open_.back());
  open_.pop_back();
}

}  // namespace understudy::config
