#include "script/script.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"
#include "robot/remote_keys.h"
#include "time/pace.h"

namespace understudy::script {
namespace {

constexpr const char* kScript = "script";
constexpr double kLongest = 1e6;   // s
constexpr double kFarthest = 100;  // m of one order to the crane; *assumed*
constexpr double kHardest = 1e6;   // N or N·s; *assumed*

[[noreturn]] void Refuse(const config::YamlValue& value, const std::string& key,
                         const std::string& what) {
  throw ConfigError(value.where + ": " + key + ": expected " + what + ", got " +
                    config::Shown(value));
}

double Number(const config::YamlValue& value, const std::string& key, double low, double high,
              const std::string& what) {
  double number = 0;
  const char* end = value.text.data() + value.text.size();
  const bool scalar = value.kind == config::YamlValue::Kind::kScalar && !value.quoted;
  const auto [stop, error] = std::from_chars(value.text.data(), end, number);
  if (!scalar || error != std::errc() || stop != end || !(number >= low && number <= high)) {
    Refuse(value, key, what);
  }
  return number;
}

double Seconds(const config::YamlValue& value, const std::string& key) {
  return Number(value, key, 0, kLongest, "seconds");
}

bool OnOff(const config::YamlValue& value, const std::string& key) {
  const auto is = [&](const char* word) {
    return value.kind == config::YamlValue::Kind::kScalar && value.text == word;
  };
  if (is("on") || is("true")) return true;
  if (is("off") || is("false")) return false;
  Refuse(value, key, "on or off");
}

std::uint16_t Keys(const config::YamlValue& value, const std::string& key) {
  const auto keys =
      value.kind == config::YamlValue::Kind::kScalar ? robot::RemoteKeys(value.text) : std::nullopt;
  if (!keys) Refuse(value, key, "keys of the remote controller, as in L2+B");
  return *keys;
}

// Refuses keys of a mapping that are none of `known`.
void CheckKeys(const config::YamlValue& map, const std::vector<std::string>& known) {
  for (const config::YamlValue& key : map.keys) {
    if (std::find(known.begin(), known.end(), key.text) == known.end()) {
      throw ConfigError(key.where + ": unknown key " + config::Shown(key) +
                        DidYouMean(key.text, known));
    }
  }
}

emulator::Order ReadCrane(const config::YamlValue& value, double) {
  const auto is = [&](const char* word) {
    return value.kind == config::YamlValue::Kind::kScalar && value.text == word;
  };
  if (is("attach")) return emulator::AttachCrane{};
  if (is("release")) return emulator::ReleaseCrane{};
  if (value.kind != config::YamlValue::Kind::kMap || value.keys.size() != 1) {
    Refuse(value, "crane", "attach, release, {lower: M} or {raise: M}");
  }
  CheckKeys(value, {"lower", "raise"});
  const std::string& key = value.keys.front().text;
  const double by = Number(value.items.front(), "crane." + key, -kFarthest, kFarthest, "metres");
  return emulator::LowerCrane{key == "lower" ? by : -by};
}

emulator::Order ReadPush(const config::YamlValue& value, double seconds) {
  if (value.kind != config::YamlValue::Kind::kMap) {
    Refuse(value, "push", "{body: NAME, force: [X, Y, Z]} or, in place of force, impulse");
  }
  CheckKeys(value, {"body", "force", "impulse"});
  const config::YamlValue* force = value.Find("force");
  const config::YamlValue* impulse = value.Find("impulse");
  if ((force == nullptr) == (impulse == nullptr)) {
    Refuse(value, "push", "either force or impulse");
  }
  if (seconds <= 0) throw ConfigError(value.where + ": push: needs a time to act, as in for: 0.1");
  const config::YamlValue& vector = force != nullptr ? *force : *impulse;
  const std::string key = force != nullptr ? "push.force" : "push.impulse";
  if (vector.kind != config::YamlValue::Kind::kSequence || vector.items.size() != 3) {
    Refuse(vector, key, "three numbers");
  }
  emulator::PushBody push{.seconds = seconds};
  for (std::size_t i = 0; i < 3; ++i) {
    push.force[static_cast<Eigen::Index>(i)] =
        Number(vector.items[i], key, -kHardest, kHardest, "a number") /
        (force != nullptr ? 1 : seconds);
  }
  if (const config::YamlValue* body = value.Find("body")) push.body = body->text;
  return push;
}

emulator::Order ReadSticks(const config::YamlValue& value, double seconds) {
  if (value.kind != config::YamlValue::Kind::kMap)
    Refuse(value, "sticks", "{lx: X, ly: Y, rx: X, ry: Y}");
  CheckKeys(value, {"lx", "ly", "rx", "ry"});
  emulator::MoveSticks sticks{.seconds = seconds};
  const std::pair<const char*, std::optional<double>*> axes[] = {
      {"lx", &sticks.lx}, {"ly", &sticks.ly}, {"rx", &sticks.rx}, {"ry", &sticks.ry}};
  for (const auto& [name, stick] : axes) {
    if (const config::YamlValue* axis = value.Find(name)) {
      *stick = Number(*axis, std::string("sticks.") + name, -1, 1, "a number from -1 to 1");
    }
  }
  return sticks;
}

emulator::Order ReadPress(const config::YamlValue& value, double seconds) {
  emulator::PressRemote press{.keys = Keys(value, "press")};
  if (seconds > 0) press.seconds = seconds;
  return press;
}

emulator::Order ReadReset(const config::YamlValue& value, double) {
  const bool word = value.kind == config::YamlValue::Kind::kScalar;
  if (word && (value.text == "true" || value.text == "on")) return emulator::ResetRobot{};
  const auto pose = word ? robot::FindStartPose(value.text) : std::nullopt;
  if (!pose) Refuse(value, "reset", "true, lying, standing, hanging or clamped");
  return emulator::ResetRobot{.pose = pose};
}

emulator::Order ReadSpeed(const config::YamlValue& value, double) {
  if (value.kind == config::YamlValue::Kind::kScalar && value.text == "max")
    return emulator::SetSpeed{.speed = 0};
  const double speed = Number(value, "speed", 0, time::kMostSpeed, time::kSpeedRange);
  if (!time::IsSpeed(speed)) Refuse(value, "speed", time::kSpeedRange);
  return emulator::SetSpeed{.speed = speed};
}

struct Event {
  const char* key;
  bool takes_time;  // whether `for` may stand beside it
  emulator::Order (*read)(const config::YamlValue& value, double seconds);
};

constexpr Event kEvents[] = {
    {"press", true, ReadPress},
    {"hold", false,
     [](const config::YamlValue& v, double) -> emulator::Order {
       return emulator::HoldRemote{Keys(v, "hold")};
     }},
    {"release", false,
     [](const config::YamlValue& v, double) -> emulator::Order {
       return emulator::ReleaseRemote{Keys(v, "release")};
     }},
    {"sticks", true, ReadSticks},
    {"remote", false,
     [](const config::YamlValue& v, double) -> emulator::Order {
       return emulator::SwitchRemote{OnOff(v, "remote")};
     }},
    {"crane", false, ReadCrane},
    {"clamp", false,
     [](const config::YamlValue& v, double) -> emulator::Order {
       return emulator::ClampBase{OnOff(v, "clamp")};
     }},
    {"push", true, ReadPush},
    {"reset", false, ReadReset},
    {"speed", false, ReadSpeed},
};

emulator::ScriptEvent ReadEvent(const config::YamlValue& value) {
  if (value.kind != config::YamlValue::Kind::kMap) {
    Refuse(value, kScript, "an event, as in {at: 1.5, press: L2+B}");
  }
  std::vector<std::string> known{"at", "for"};
  std::string words;
  for (const Event& event : kEvents) {
    known.emplace_back(event.key);
    words += (words.empty() ? "" : ", ") + known.back();
  }
  CheckKeys(value, known);
  const config::YamlValue* at = value.Find("at");
  if (at == nullptr) throw ConfigError(value.where + ": at: missing; when is it to happen?");

  const Event* found = nullptr;
  for (const Event& event : kEvents) {
    if (value.Find(event.key) == nullptr) continue;
    if (found != nullptr) {
      throw ConfigError(value.where + ": one event cannot be both " + found->key + " and " +
                        event.key);
    }
    found = &event;
  }
  if (found == nullptr) throw ConfigError(value.where + ": expected one of " + words);
  const config::YamlValue* time = value.Find("for");
  if (time != nullptr && !found->takes_time) {
    throw ConfigError(time->where + ": for: " + found->key + " takes no time");
  }
  return {
      .at = Seconds(*at, "at"),
      .order = found->read(*value.Find(found->key), time == nullptr ? 0 : Seconds(*time, "for")),
      .where = value.where};
}

}  // namespace

bool IsScript(const config::YamlValue& document) { return document.Find(kScript) != nullptr; }

std::vector<emulator::ScriptEvent> ReadScript(const config::YamlValue& document) {
  const config::YamlValue* list = document.Find(kScript);
  if (list == nullptr || list->kind != config::YamlValue::Kind::kSequence) {
    Refuse(list == nullptr ? document : *list, kScript,
           "a list of events, as in [{at: 1.5, press: L2+B}]");
  }
  CheckKeys(document, {kScript});
  std::vector<emulator::ScriptEvent> events;
  for (const config::YamlValue& item : list->items) events.push_back(ReadEvent(item));
  std::ranges::stable_sort(events, std::ranges::less(), &emulator::ScriptEvent::at);
  return events;
}

std::vector<emulator::ScriptEvent> LoadScript(const std::filesystem::path& file) {
  return ReadScript(config::ReadYamlFile(file));
}

}  // namespace understudy::script
