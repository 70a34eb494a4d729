#include "rehearse/with_settings.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::rehearse {
namespace {

using schema::YamlValue;

// Replaces placeholders, and notes which were met.
class Replacer {
 public:
  explicit Replacer(const std::vector<Setting>& settings) {
    for (const Setting& setting : settings) {
      if (setting.key.front() == '$') settings_.push_back(&setting);
    }
  }

  void Replace(YamlValue* value) {
    for (YamlValue& item : value->items) Replace(&item);
    if (value->kind != YamlValue::Kind::kScalar || value->text.find('$') == std::string::npos)
      return;
    const Setting* whole = value->quoted ? nullptr : Known(value->text);
    if (whole == nullptr) {
      ReplaceIn(&value->text);
      return;
    }
    met_.insert(whole->key);
    *value = schema::ParseYaml(whole->text, value->where, /*numbered=*/false);
  }

  // Within a text a value stands as its letters, without quotes of YAML.
  void ReplaceIn(std::string* text) {
    std::string replaced;
    for (std::size_t i = 0; i < text->size();) {
      std::size_t end = i + 1;
      if ((*text)[i] == '$') {
        while (end < text->size() && IsPlaceholder(text->substr(i, end + 1 - i))) ++end;
      }
      const std::string word = text->substr(i, end - i);
      const Setting* known = Known(word);
      if (known != nullptr) {
        met_.insert(word);
        const YamlValue value = schema::ParseYaml(known->text, word, /*numbered=*/false);
        replaced += value.kind == YamlValue::Kind::kScalar ? value.text : known->text;
      } else {
        if (IsPlaceholder(word)) unknown_.push_back(word);
        replaced += word;
      }
      i = end;
    }
    *text = std::move(replaced);
  }

  void RequireAll(const Plan& plan) const {
    for (const Axis& axis : plan.axes()) {
      if (axis.key.front() != '$' || met_.contains(axis.key)) continue;
      throw ConfigError(axis.where + ": vary: " + axis.key + ": nothing in the scenario says so" +
                        (unknown_.empty() ? "" : DidYouMean(axis.key, unknown_)));
    }
  }

 private:
  const Setting* Known(const std::string& word) const {
    const auto found = std::ranges::find_if(
        settings_, [&word](const Setting* setting) { return setting->key == word; });
    return found == settings_.end() ? nullptr : *found;
  }

  std::vector<const Setting*> settings_;
  std::set<std::string> met_;
  std::vector<std::string> unknown_;
};

// A key with a dot is one of a mapping below.
void SetKey(const std::string& key, YamlValue value, YamlValue* map) {
  if (const std::size_t dot = key.find('.'); dot != std::string::npos) {
    const std::string head = key.substr(0, dot), rest = key.substr(dot + 1);
    YamlValue* below = map->Find(head);
    const bool there = below != nullptr && below->kind == YamlValue::Kind::kMap;
    if (there) return SetKey(rest, std::move(value), below);
    return SetKey(head, schema::MapOf(rest, std::move(value)), map);
  }
  if (YamlValue* old = map->Find(key)) {
    *old = std::move(value);
    return;
  }
  const YamlValue tree = schema::MapOf(key, std::move(value));
  map->keys.push_back(tree.keys.front());
  map->items.push_back(tree.items.front());
}

}  // namespace

YamlValue WithSettings(const YamlValue& document, const Plan& plan,
                       const std::vector<Setting>& settings, std::vector<std::string>* sets,
                       std::vector<std::string>* command) {
  YamlValue varied = document;
  Replacer replacer(settings);
  for (std::size_t i = 0; i < varied.items.size(); ++i) {
    if (varied.keys[i].text != "vary") replacer.Replace(&varied.items[i]);
  }
  if (command != nullptr) {
    for (std::string& word : *command) replacer.ReplaceIn(&word);
    replacer.RequireAll(plan);
  }
  std::vector<std::string> own;
  for (std::size_t i = 0; i < settings.size(); ++i) {
    const auto& [key, text] = settings[i];
    if (key.front() == '$') continue;
    if (std::ranges::find(kVariedKeys, key) != std::end(kVariedKeys)) {
      SetKey(key, schema::ParseYaml(text, plan.axes()[i].where, /*numbered=*/false), &varied);
    } else {
      own.push_back(key + "=" + text);
    }
  }
  sets->insert(sets->begin(), own.begin(), own.end());
  return varied;
}

}  // namespace understudy::rehearse
