// Formats replies of a robot for a person, as `understudy ctl` prints them.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "client/client.h"

namespace understudy::ctl {

using Cells = std::vector<std::string>;

// Pads every column but the last of each row to its widest cell, two spaces between columns.
std::string Aligned(const std::vector<Cells>& rows);

// Single facts of a status: "ready", "1.000", "mcf, state 1002", "crc 2, gain 1".
std::string StateText(const nlohmann::ordered_json& status);
std::string SpeedText(const nlohmann::ordered_json& speed);
std::string ServiceText(const nlohmann::ordered_json& motion);
std::string ReasonsText(const nlohmann::ordered_json& commands);

// Lines of label, value and unit. `status` is what StatusJson yields; throws json::exception where
// it is not.
std::string StatusText(const nlohmann::ordered_json& status);

// Whatever JSON object it is: lines of key and value, and lists of objects as tables below.
std::string FieldsText(const nlohmann::ordered_json& object);

// "12.345 s  paused at 12.345 s" of an event as GET /events has it, and all of that reply's.
std::string EventText(const nlohmann::ordered_json& event);
std::string EventsText(const nlohmann::ordered_json& reply);

// Lines of name, process and socket under a heading; a sentence when there are no robots.
std::string RobotsText(const std::vector<client::RunningRobot>& robots);

}  // namespace understudy::ctl
