#include "script/script.h"

#include <algorithm>
#include <functional>
#include <string>
#include <utility>

#include <nlohmann/json.hpp>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::script {
namespace {

using nlohmann::json;

constexpr const char* kScript = "script";
constexpr double kLatest = 1e6;  // s; *assumed*

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

std::vector<std::string> EventKeys() {
  std::vector<std::string> keys{"at"};
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    if (row.from != emulator::From::kPeople) keys.emplace_back(row.name);
  }
  return keys;
}

emulator::ScriptEvent ReadEvent(const config::YamlValue& value) {
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
    if (key.text == "at") continue;
    if (name != nullptr) {
      throw ConfigError(value.where + ": one event cannot be both " + name->text + " and " +
                        key.text);
    }
    name = &key;
  }
  const config::YamlValue* at = value.Find("at");
  if (at == nullptr)
    throw ConfigError(value.where + ": at: missing; expected the time of the event in seconds");
  const json time = JsonOf(*at);
  if (!time.is_number() || !(time >= 0) || !(time <= kLatest)) Refuse(*at, "at", "seconds");
  if (name == nullptr) throw ConfigError(value.where + ": what is to happen at " + at->text + "?");
  const config::YamlValue& values = *value.Find(name->text);
  std::string wrong;
  const auto request = emulator::ReadRequest(name->text, JsonOf(values), &wrong);
  if (!request) {
    const auto key = std::ranges::find(values.keys, wrong, &config::YamlValue::text);
    const std::string& where = key == values.keys.end() ? name->where : key->where;
    throw ConfigError(where + ": " + name->text + ": " + request.why());
  }
  return {.at = time, .request = *request, .where = value.where};
}

}  // namespace

bool IsScript(const config::YamlValue& document) { return document.Find(kScript) != nullptr; }

std::vector<emulator::ScriptEvent> ReadEvents(const config::YamlValue& list) {
  if (list.kind != config::YamlValue::Kind::kSequence) {
    Refuse(list, kScript, "a list of events, as in [{at: 1.5, remote.press: L2+B}]");
  }
  std::vector<emulator::ScriptEvent> events;
  for (const config::YamlValue& item : list.items) events.push_back(ReadEvent(item));
  std::ranges::stable_sort(events, std::ranges::less(), &emulator::ScriptEvent::at);
  return events;
}

std::vector<emulator::ScriptEvent> ReadScript(const config::YamlValue& document) {
  const config::YamlValue* list = document.Find(kScript);
  if (list == nullptr) return ReadEvents(document);  // which says what was expected
  for (const config::YamlValue& key : document.keys) {
    if (key.text != kScript) {
      throw ConfigError(key.where + ": unknown key " + config::Shown(key) +
                        DidYouMean(key.text, {kScript}));
    }
  }
  return ReadEvents(*list);
}

std::vector<emulator::ScriptEvent> LoadScript(const std::filesystem::path& file) {
  return ReadScript(config::ReadYamlFile(file));
}

}  // namespace understudy::script
