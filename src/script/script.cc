#include "script/script.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <memory>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "signals/bound_condition.h"

namespace understudy::script {
namespace {

using nlohmann::json;

constexpr const char* kScript = "script";
constexpr double kLatest = 1e6;  // s; *assumed*
// Bounds the length of a tick: 256 of four comparisons take 8 us of it (measured). *Assumed*.
constexpr std::size_t kMostWaits = 256;

[[noreturn]] void Refuse(const config::YamlValue& value, const std::string& key,
                         const std::string& what) {
  throw ConfigError(value.where + ": " + key + ": expected " + what + ", got " +
                    config::Shown(value));
}

// Converts YAML to JSON. The recursion is bounded by ParseYaml's limit of depth.
json JsonOf(const config::YamlValue& value) {
  using Kind = config::YamlValue::Kind;
  json of;
  if (value.kind == Kind::kScalar)
    of = value.quoted ? json(value.text) : emulator::ValueOf(value.text);
  if (value.kind == Kind::kSequence) {
    of = json::array();
    for (const config::YamlValue& item : value.items) of.push_back(JsonOf(item));
  }
  if (value.kind == Kind::kMap) {
    of = json::object();
    for (std::size_t i = 0; i < value.keys.size(); ++i) {
      of[value.keys[i].text] = JsonOf(value.items[i]);
    }
  }
  return of;
}

constexpr const char* kAt = "at";
constexpr const char* kAfter = "after";
constexpr const char* kWhen = "when";
constexpr const char* kWithin = "within";

bool IsTimeKey(const std::string& key) {
  return key == kAt || key == kAfter || key == kWhen || key == kWithin;
}

std::vector<std::string> EventKeys() {
  std::vector<std::string> keys{kAt, kAfter, kWhen, kWithin};
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    if (row.from != emulator::From::kPeople) keys.emplace_back(row.name);
  }
  return keys;
}

double SecondsOf(const config::YamlValue& value, const char* key) {
  const json time = JsonOf(value);
  if (!time.is_number() || !(time >= 0) || !(time <= kLatest)) Refuse(value, key, "seconds");
  return time;
}

// Reads when an event happens.
void ReadTime(const config::YamlValue& value, const signals::Names& names, bool first,
              signals::Conditions* conditions, emulator::ScriptEvent* event) {
  const config::YamlValue* at = value.Find(kAt);
  const config::YamlValue* after = value.Find(kAfter);
  const config::YamlValue* when = value.Find(kWhen);
  const config::YamlValue* within = value.Find(kWithin);
  if (at == nullptr && after == nullptr && when == nullptr) {
    throw ConfigError(value.where +
                      ": at: missing; expected the time of the event in seconds, or when, or "
                      "after: previous");
  }
  if (at != nullptr) event->at = SecondsOf(*at, kAt);
  if (after != nullptr) {
    if (after->text != "previous") Refuse(*after, kAfter, "previous");
    if (first) throw ConfigError(after->where + ": after: no event comes before this one");
    event->after = true;
  }
  if (within != nullptr) {
    if (when == nullptr) throw ConfigError(within->where + ": within: only beside when");
    event->within = SecondsOf(*within, kWithin);
  }
  if (when == nullptr) return;
  if (when->kind != config::YamlValue::Kind::kScalar) {
    Refuse(*when, kWhen, "a condition, as in lowcmd arrives");
  }
  if (conditions->formulas.size() == kMostWaits) {
    throw ConfigError(when->where + ": when: a script waits at most " + std::to_string(kMostWaits) +
                      " times");
  }
  auto bound = signals::BindCondition(when->text, names, &conditions->signals);
  if (!bound) throw ConfigError(when->where + ": when: " + bound.why());
  event->when = conditions->formulas.size();
  event->condition = config::OneLine(when->text);
  conditions->formulas.push_back(std::move(bound->formula));
}

emulator::ScriptEvent ReadEvent(const config::YamlValue& value, const signals::Names& names,
                                bool first, signals::Conditions* conditions) {
  if (value.kind != config::YamlValue::Kind::kMap) {
    Refuse(value, kScript, "an event, as in {at: 1.5, remote.press: L2+B}");
  }
  static const std::vector<std::string> kKeys = EventKeys();
  const config::YamlValue* name = nullptr;
  for (const config::YamlValue& key : value.keys) {
    if (std::ranges::find(kKeys, key.text) == kKeys.end()) {
      throw ConfigError(key.where + ": unknown key " + config::Shown(key) +
                        DidYouMean(key.text, kKeys));
    }
    if (IsTimeKey(key.text)) continue;
    if (name != nullptr) {
      throw ConfigError(value.where + ": one event cannot be both " + name->text + " and " +
                        key.text);
    }
    name = &key;
  }
  emulator::ScriptEvent event{.where = value.where};
  ReadTime(value, names, first, conditions, &event);
  if (name == nullptr) {
    const config::YamlValue* at = value.Find(kAt);
    throw ConfigError(value.where + ": what is to happen" +
                      (at == nullptr ? "" : " at " + at->text) + "?");
  }
  const config::YamlValue& values = *value.Find(name->text);
  std::string wrong;
  const auto request = emulator::ReadRequest(name->text, JsonOf(values), &wrong);
  if (!request) {
    const auto key = std::ranges::find(values.keys, wrong, &config::YamlValue::text);
    const std::string& where = key == values.keys.end() ? name->where : key->where;
    throw ConfigError(where + ": " + name->text + ": " + request.why());
  }
  event.request = *request;
  return event;
}

}  // namespace

bool IsScript(const config::YamlValue& document) { return document.Find(kScript) != nullptr; }

Script ReadEvents(const config::YamlValue& list, const signals::Names& names) {
  if (list.kind != config::YamlValue::Kind::kSequence) {
    Refuse(list, kScript, "a list of events, as in [{at: 1.5, remote.press: L2+B}]");
  }
  Script script;
  std::vector<std::vector<emulator::ScriptEvent>> sequences;
  for (const config::YamlValue& item : list.items) {
    emulator::ScriptEvent event = ReadEvent(item, names, sequences.empty(), &script.conditions);
    if (!event.after) sequences.emplace_back();
    sequences.back().push_back(std::move(event));
  }
  std::ranges::stable_sort(sequences, std::ranges::less(),
                           [](const auto& sequence) { return sequence.front().at; });
  for (auto& sequence : sequences) {
    std::ranges::move(sequence, std::back_inserter(script.events));
  }
  return script;
}

Script ReadScript(const config::YamlValue& document, const signals::Names& names) {
  const config::YamlValue* list = document.Find(kScript);
  if (list == nullptr) return ReadEvents(document, names);  // which says what was expected
  for (const config::YamlValue& key : document.keys) {
    if (key.text != kScript) {
      throw ConfigError(key.where + ": unknown key " + config::Shown(key) +
                        DidYouMean(key.text, {kScript}));
    }
  }
  return ReadEvents(*list, names);
}

Script LoadScript(const std::filesystem::path& file, const signals::Names& names) {
  return ReadScript(config::ReadYamlFile(file), names);
}

void Play(const Script& script, emulator::World* world) {
  world->Play(script.events, script.conditions.formulas.empty()
                                 ? nullptr
                                 : std::make_unique<signals::Watch>(script.conditions, *world));
}

}  // namespace understudy::script
