// Reads scripts: YAML lists of events for a robot, and what they wait for
// (docs/reference/scripts.md).
#pragma once

#include <filesystem>
#include <vector>

#include "emulator/script.h"
#include "emulator/world.h"
#include "schema/yaml_document.h"
#include "signals/condition_watch.h"

namespace understudy::script {

struct Script {
  // Each that does not come after another is followed by those that come after it, and is in its
  // place by its time, of equal ones by the file.
  std::vector<emulator::ScriptEvent> events{};
  signals::Conditions conditions{};  // for which events wait
};

// Returns whether a document is a script: a mapping with the key `script`.
bool IsScript(const schema::YamlValue& document);

// Read the events of a list, or of the document or file `script: [...]`, for a robot that has these
// names; in a world of several an event names its robot. Throw ConfigError with file, line, key,
// what was expected and what was found.
Script ReadEvents(const schema::YamlValue& list, const signals::Names& names);
Script ReadScript(const schema::YamlValue& document, const signals::Names& names);
Script LoadScript(const std::filesystem::path& file, const signals::Names& names);

// Has a world that has made no tick yet play a script, as World::Play does. Throws ConfigError too
// where a condition is about the base of a robot whose base is fixed.
void Play(const Script& script, emulator::World* world);

}  // namespace understudy::script
