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
#include "schema/node.h"
#include "schema/yaml_reader.h"
#include "signals/bound_condition.h"

namespace understudy::script {
namespace {

using nlohmann::json;
using schema::JsonOf;
using schema::Refuse;

constexpr const char* kScript = "script";
constexpr double kLatest = 1e6;  // s; *assumed*
// Bounds the length of a tick: 256 of four comparisons take 8 us of it (measured). *Assumed*.
constexpr std::size_t kMostWaits = 256;

constexpr const char* kAt = "at";
constexpr const char* kAfter = "after";
constexpr const char* kWhen = "when";
constexpr const char* kWithin = "within";
constexpr const char* kRobot = "robot";
// Requests to the world, whichever robot they come by.
constexpr std::string_view kOfWorld[] = {"pause", "speed"};

bool IsCommonKey(const std::string& key) {
  return key == kAt || key == kAfter || key == kWhen || key == kWithin || key == kRobot;
}

std::vector<std::string> EventKeys() {
  std::vector<std::string> keys{kAt, kAfter, kWhen, kWithin, kRobot};
  for (const emulator::RequestRow& row : emulator::RequestRows()) {
    if (row.from != emulator::From::kPeople) keys.emplace_back(row.name);
  }
  return keys;
}

double SecondsOf(const schema::YamlValue& value, const char* key) {
  const json time = JsonOf(value);
  if (!time.is_number() || !(time >= 0) || !(time <= kLatest)) Refuse(value, key, "seconds");
  return time;
}

std::string Listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

// Reads when an event happens.
void ReadTime(const schema::YamlValue& value, const signals::Names& names, bool first,
              signals::Conditions* conditions, emulator::ScriptEvent* event) {
  const schema::YamlValue* at = value.Find(kAt);
  const schema::YamlValue* after = value.Find(kAfter);
  const schema::YamlValue* when = value.Find(kWhen);
  const schema::YamlValue* within = value.Find(kWithin);
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
  if (when->kind != schema::YamlValue::Kind::kScalar) {
    Refuse(*when, kWhen, "a condition, as in lowcmd arrives");
  }
  if (conditions->formulas.size() == kMostWaits) {
    throw ConfigError(when->where + ": when: a script waits at most " + std::to_string(kMostWaits) +
                      " times");
  }
  auto bound = signals::BindCondition(when->text, names, &conditions->signals);
  if (!bound) throw ConfigError(when->where + ": when: " + bound.why());
  event->when = conditions->formulas.size();
  event->condition = schema::OneLine(when->text);
  conditions->formulas.push_back(std::move(bound->formula));
}

// The names of the robot to which an event belongs. In a world of several each event says so, but
// for one of the world.
signals::Names RobotOf(const schema::YamlValue& value, const std::string& request,
                       const signals::Names& names) {
  const schema::YamlValue* robot = value.Find(kRobot);
  std::vector<std::string> known{names.robot};
  for (const signals::Names& other : names.others) known.push_back(other.robot);
  if (robot == nullptr) {
    const bool of_world = std::ranges::find(kOfWorld, request) != std::end(kOfWorld);
    if (names.robot.empty() || of_world) return names;
    throw ConfigError(value.where + ": robot: missing; expected one of " + Listed(known));
  }
  if (names.any_robot) return names;
  if (names.robot.empty()) {
    throw ConfigError(robot->where + ": robot: this world has one robot, which needs no name");
  }
  if (auto found = names.Of(robot->text)) return *std::move(found);
  throw ConfigError(robot->where + ": robot: no robot " + schema::Shown(*robot) +
                    DidYouMean(robot->text, known));
}

// For a key that is the last part of a request's name, or the first and its value the last:
// "press" is "remote.press", "crane: {lower: 0.1}" is "crane.lower".
std::string MeantBy(const std::string& key, const schema::YamlValue& value,
                    const std::vector<std::string>& words) {
  const std::string last = value.keys.empty() ? value.text : value.keys.front().text;
  std::string meant;
  for (const std::string& word : words) {
    if (word.ends_with("." + key) || word == key + "." + last) {
      meant += (meant.empty() ? "; did you mean '" : "' or '") + word;
    }
  }
  return meant.empty() ? DidYouMean(key, words) : meant + "'?";
}

emulator::ScriptEvent ReadEvent(const schema::YamlValue& value, const signals::Names& world,
                                bool first, signals::Conditions* conditions) {
  if (value.kind != schema::YamlValue::Kind::kMap) {
    Refuse(value, kScript, "an event, as in {at: 1.5, remote.press: L2+B}");
  }
  static const std::vector<std::string> kKeys = EventKeys();
  const schema::YamlValue* name = nullptr;
  for (const schema::YamlValue& key : value.keys) {
    if (std::ranges::find(kKeys, key.text) == kKeys.end()) {
      throw ConfigError(key.where + ": unknown key " + schema::Shown(key) +
                        MeantBy(key.text, *value.Find(key.text), kKeys));
    }
    if (IsCommonKey(key.text)) continue;
    if (name != nullptr) {
      throw ConfigError(value.where + ": one event cannot be both " + name->text + " and " +
                        key.text);
    }
    name = &key;
  }
  emulator::ScriptEvent event{.where = value.where};
  const signals::Names names = RobotOf(value, name == nullptr ? "" : name->text, world);
  ReadTime(value, names, first, conditions, &event);
  if (name == nullptr) {
    const schema::YamlValue* at = value.Find(kAt);
    throw ConfigError(value.where + ": what is to happen" +
                      (at == nullptr ? "" : " at " + at->text) + "?");
  }
  const schema::YamlValue& values = *value.Find(name->text);
  std::string wrong;
  const auto request = emulator::ReadRequest(name->text, JsonOf(values), &wrong);
  if (!request) {
    const auto key = std::ranges::find(values.keys, wrong, &schema::YamlValue::text);
    const std::string& where = key == values.keys.end() ? name->where : key->where;
    throw ConfigError(where + ": " + name->text + ": " + request.why());
  }
  event.request = *request;
  if (!names.robot.empty()) event.request.robot = names.number;
  return event;
}

void ForEachLeaf(const judge::Formula& formula, const std::function<void(const judge::Leaf&)>& f) {
  if (formula.op == judge::Op::kLeaf) f(formula.leaf);
  for (const judge::Formula& part : formula.parts) ForEachLeaf(part, f);
}

}  // namespace

bool IsScript(const schema::YamlValue& document) { return document.Find(kScript) != nullptr; }

Script ReadEvents(const schema::YamlValue& list, const signals::Names& names) {
  if (list.kind != schema::YamlValue::Kind::kSequence) {
    Refuse(list, kScript, "a list of events, as in [{at: 1.5, remote.press: L2+B}]");
  }
  Script script;
  std::vector<std::vector<emulator::ScriptEvent>> sequences;
  for (const schema::YamlValue& item : list.items) {
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

Script ReadScript(const schema::YamlValue& document, const signals::Names& names) {
  if (document.Find("scenario") != nullptr || document.Find("expect") != nullptr) {
    throw ConfigError(document.where + ": this is a scenario: understudy rehearse " +
                      document.where.substr(0, document.where.rfind(':')));
  }
  const schema::YamlValue* list = document.Find(kScript);
  if (list == nullptr) return ReadEvents(document, names);  // which says what was expected
  for (const schema::YamlValue& key : document.keys) {
    if (key.text != kScript) {
      throw ConfigError(key.where + ": unknown key " + schema::Shown(key) +
                        DidYouMean(key.text, {kScript}));
    }
  }
  return ReadEvents(*list, names);
}

Script LoadScript(const std::filesystem::path& file, const signals::Names& names) {
  return ReadScript(schema::ReadYamlFile(file), names);
}

void Play(const Script& script, emulator::World* world) {
  for (const emulator::ScriptEvent& event : script.events) {
    if (!event.when) continue;
    ForEachLeaf(script.conditions.formulas[*event.when], [&](const judge::Leaf& leaf) {
      const signals::Signal& signal = script.conditions.signals[leaf.signal];
      if (!signal.object.empty() && world->physics().FindObject(signal.object) == nullptr) {
        throw ConfigError(event.where + ": when: " + signal.name + ": the scene has no object '" +
                          signal.object + "'");
      }
      if (signal.of_base && world->physics().robot(signal.robot).base_position().empty()) {
        throw ConfigError(event.where + ": when: " + signal.name +
                          ": the base of this robot is fixed and does not move");
      }
    });
  }
  world->Play(script.events,
              script.conditions.formulas.empty()
                  ? nullptr
                  : std::make_unique<signals::ConditionWatch>(script.conditions, *world));
}

}  // namespace understudy::script
