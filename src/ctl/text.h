// Formats replies of a robot for a person.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "client/client.h"

namespace understudy::ctl {

using Cells = std::vector<std::string>;

// Pads each column but the last to its widest cell, with two spaces between columns.
std::string Aligned(const std::vector<Cells>& rows);

// Format parts of a status: "ready", "1.000", "mcf, lying (1004)", "crc 2, gain 1".
std::string StateText(const nlohmann::ordered_json& status);
std::string SpeedText(const nlohmann::ordered_json& speed);
std::string ServiceText(const nlohmann::ordered_json& motion);
// Says whom the motors follow, from the commands of a status.
std::string FollowedText(const nlohmann::ordered_json& commands);
std::string ReasonsText(const nlohmann::ordered_json& commands);
// "s.yaml:4: lowcmd arrives", "" if no event waits.
std::string ScriptText(const nlohmann::ordered_json& script);

// Formats a status as lines of label, value and unit. `status` is the JSON of StatusJson; throws
// json::exception for any other.
std::string StatusText(const nlohmann::ordered_json& status);

// Formats any JSON object: lines of key and value, with lists of objects as tables below.
std::string FieldsText(const nlohmann::ordered_json& object);

// Formats the part `damage` of a snapshot: a table of the figures with limits and marks, and one of
// the motors that are near a limit or beyond it; `all` adds the other motors and the limits'
// sources.
std::string DamageText(const nlohmann::ordered_json& snapshot, bool all);
// Returns how many figures of the part `damage` are beyond their limits.
std::int64_t BeyondCount(const nlohmann::ordered_json& snapshot);

// Formats the part `faults` of a snapshot as a table.
std::string FaultsText(const nlohmann::ordered_json& snapshot);

// Formats the reply to GET /settings as a table.
std::string SettingsText(const nlohmann::ordered_json& reply);

// Format one event of the reply to GET /events, as "12.345 s paused at 12.345 s", and all of them:
// late ticks are one line, at the last of them.
std::string EventText(const nlohmann::ordered_json& event);
std::string EventsText(const nlohmann::ordered_json& reply);

// Formats lines of name, process and socket under a heading; a sentence if there are no robots.
std::string RobotsText(const std::vector<client::RunningRobot>& robots);

}  // namespace understudy::ctl
