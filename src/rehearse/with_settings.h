// Applies the settings of one run of a campaign to a scenario.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "rehearse/vary.h"
#include "schema/yaml_document.h"

namespace understudy::rehearse {

// The keys of a scenario that may vary, beside those of its `settings`.
inline constexpr std::string_view kVariedKeys[] = {"robot", "revision",     "start", "profile",
                                                   "seed",  "scene",        "speed", "duration",
                                                   "clock", "program.think"};

// Returns the document with these settings in it: keys of the scenario are replaced, `$name` where
// it stands. Those of the configuration are left to `sets`, to which they are added as KEY=VALUE.
// Replaces `$name` in the words of `command`, too; throws ConfigError for one that stands neither
// there nor in the scenario. A null `command` is one that is not known.
schema::YamlValue WithSettings(const schema::YamlValue& document, const Plan& plan,
                               const std::vector<Setting>& settings, std::vector<std::string>* sets,
                               std::vector<std::string>* command);

}  // namespace understudy::rehearse
