#include "server/request_docs.h"

#include <algorithm>
#include <array>
#include <vector>

#include "config/setting_keys.h"
#include "emulator/live_settings.h"

namespace understudy::server {
namespace {

using emulator::Field;
using emulator::FieldKind;
using emulator::NumberText;
using emulator::RequestRow;
using nlohmann::ordered_json;

constexpr std::string_view kHead =
    "# Requests\n\n"
    "Written by `understudy requests > docs/requests.md` from the table that carries them out.\n\n"
    "What people and scripts ask of a running robot, by the same names and with the same values "
    "everywhere:\n\n"
    "| from | as |\n|---|---|\n"
    "| a shell | `understudy ctl crane lower 0.2`, `understudy ctl push base_link 0 60 0 --for "
    "0.2`: values in capitals below are bare words, others options |\n"
    "| HTTP | `POST /crane/lower` with `{\"by\": 0.2}` |\n"
    "| WebSocket `/requests` | `{\"crane.lower\": {\"by\": 0.2}, \"id\": 1}` |\n"
    "| a script | `- {at: 3, crane.lower: {by: 0.2}}` |\n\n"
    "Where the first value is in capitals it may stand alone: `crane.lower: 0.2`. `GET /requests` "
    "gives this table as JSON ([control.md](control.md), [scripts.md](scripts.md)). Bounds and "
    "defaults are *assumed*: far beyond what is of use. In a world of several robots `robot` "
    "beside "
    "the values is the number of the one that is meant, from 0; a run has number 0 alone.\n\n"
    "| request | value | takes | default | meaning |\n|---|---|---|---|---|\n";

constexpr std::string_view kFoot =
    "\nKeys: R1 L1 START SELECT R2 L2 F1 F2 A B X Y UP RIGHT DOWN LEFT, joined by `+`. What chords "
    "do stands in the robot's YAML, `robot.remote.chords`. The remote controller is there from its "
    "first request on.\n";

std::string DefaultOf(const Field& field) {
  if (field.required) return "needed";
  if (!field.otherwise) return "";
  if (field.kind == FieldKind::kSwitch) return *field.otherwise != 0 ? "on" : "off";
  if (field.kind != FieldKind::kVector) return NumberText(*field.otherwise);
  const std::string number = NumberText(*field.otherwise);
  return number + " " + number + " " + number;
}

constexpr std::array<std::string_view, 13> kKinds = {
    "number", "whole", "vector", "switch", "speed",   "word", "keys",
    "body",   "name",  "json",   "file",   "setting", "value"};
static_assert(kKinds.size() == static_cast<std::size_t>(FieldKind::kValue) + 1);
constexpr std::array<std::string_view, 3> kFrom = {"both", "people", "script"};
static_assert(kFrom.size() == static_cast<std::size_t>(emulator::From::kScript) + 1);

bool HasRange(const Field& field) {
  return field.kind == FieldKind::kNumber || field.kind == FieldKind::kWhole ||
         field.kind == FieldKind::kVector;
}

ordered_json FieldJson(const Field& field) {
  ordered_json json{{"key", field.key}, {"kind", kKinds[static_cast<std::size_t>(field.kind)]}};
  if (!field.unit.empty()) json["unit"] = field.unit;
  if (HasRange(field)) json["range"] = {field.low, field.high};
  if (!field.words.empty()) json["words"] = field.words;
  if (field.otherwise) json["default"] = *field.otherwise;
  json["required"] = field.required;
  json["does"] = field.does;
  return json;
}

ordered_json SchemaOf(const Field& field) {
  ordered_json number{{"type", field.kind == FieldKind::kWhole ? "integer" : "number"}};
  if (HasRange(field)) {
    number["minimum"] = field.low;
    number["maximum"] = field.high;
  }
  ordered_json schema;
  switch (field.kind) {
    case FieldKind::kNumber:
    case FieldKind::kWhole:
      schema = number;
      if (field.otherwise) schema["default"] = *field.otherwise;
      break;
    case FieldKind::kVector:
      schema = {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
      break;
    case FieldKind::kSwitch:
      schema = {{"type", "boolean"}};
      if (field.otherwise) schema["default"] = *field.otherwise != 0;
      break;
    case FieldKind::kSpeed:
      schema = {{"oneOf",
                 {{{"type", "number"}, {"minimum", 0.001}, {"maximum", 1000}},
                  {{"type", "string"}, {"enum", {"max"}}}}}};
      break;
    case FieldKind::kWord:
      schema = {{"type", "string"}, {"enum", field.words}};
      break;
    case FieldKind::kKeys:
    case FieldKind::kBody:
    case FieldKind::kName:
    case FieldKind::kJson:
    case FieldKind::kFile:
      schema = {{"type", "string"}};
      break;
    case FieldKind::kSetting: {
      std::vector<std::string_view> keys;
      for (const emulator::LiveSetting& one : emulator::LiveSettings()) keys.push_back(one.key);
      schema = {{"type", "string"}, {"enum", keys}};
      break;
    }
    case FieldKind::kValue:
      schema = {{"oneOf", {{{"type", "number"}}, {{"type", "boolean"}}, {{"type", "string"}}}}};
      break;
  }
  const std::string unit = field.unit.empty() ? "" : std::string(field.unit) + ". ";
  schema["description"] = unit + std::string(field.does);
  return schema;
}

// The settings that `set` changes, and why others cannot be.
std::string SettingsReference() {
  std::string text =
      "\n## Settings\n\nWhat `set` changes, and `ctl set` and `GET /settings` list with the values "
      "of now. Units and ranges are those of [the configuration](config.md). A value holds from "
      "the "
      "next step on and over resets; it is told as the event `setting`, and a recording has it.\n\n"
      "| key | takes | meaning |\n|---|---|---|\n";
  for (const emulator::SettingKey& key : config::SettingKeys()) {
    text += "| `" + key.key + "` | " + key.expected + " | " + key.does + " |\n";
  }
  text +=
      "\n`terrain.friction` is then that of all ground, also of patches with a friction of their "
      "own; 0 gives back what the run began with, which stands behind the 0 in `ctl set`. What is "
      "drawn for a robot, such as a bias, is scaled, not drawn again.\n\nOther keys cannot "
      "change:\n\n| keys | because |\n|---|---|\n";
  for (const emulator::FixedSetting& fixed : emulator::FixedSettings()) {
    const bool group = fixed.begins.ends_with('.');
    text += "| `" + std::string(fixed.begins) + (group ? "*` | " : "` | ") +
            std::string(fixed.why) + " |\n";
  }
  return text;
}

std::string OperationId(const RequestRow& row) {
  std::string id = "post";
  bool upper = true;
  for (const char c : row.name) {
    if (c == '.' || c == '_') {
      upper = true;
    } else {
      id += upper ? Capitals({&c, 1}) : std::string(1, c);
      upper = false;
    }
  }
  return id;
}

}  // namespace

std::string Capitals(std::string_view key) {
  std::string upper(key);
  std::ranges::transform(upper, upper.begin(), [](char c) {
    return c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  });
  return upper;
}

std::string RequestPath(const RequestRow& row) {
  std::string path = "/" + std::string(row.name);
  std::ranges::replace(path, '.', '/');
  return path;
}

ordered_json RequestsJson() {
  ordered_json rows = ordered_json::array();
  for (const RequestRow& row : emulator::RequestRows()) {
    ordered_json fields = ordered_json::array();
    for (const Field& field : row.fields) fields.push_back(FieldJson(field));
    rows.push_back({{"name", row.name},
                    {"does", row.does},
                    {"from", kFrom[static_cast<std::size_t>(row.from)]},
                    {"fields", fields}});
  }
  return {{"requests", rows}};
}

std::string RequestsReference() {
  std::string text(kHead);
  for (const RequestRow& row : emulator::RequestRows()) {
    const std::string_view from = row.from == emulator::From::kPeople   ? ". Not in scripts"
                                  : row.from == emulator::From::kScript ? ". In scripts only"
                                                                        : "";
    text += "| `" + std::string(row.name) + "` | | | | " + std::string(row.does) +
            std::string(from) + " |\n";
    for (const Field& field : row.fields) {
      const std::string key = field.bare ? Capitals(field.key) : std::string(field.key);
      text += "| | `" + key + "` | " + emulator::Expected(field) + " | " + DefaultOf(field) +
              " | " + std::string(field.does) + " |\n";
    }
  }
  return text + SettingsReference() + std::string(kFoot);
}

std::string RequestsOpenApi() {
  std::string text;
  for (const RequestRow& row : emulator::RequestRows()) {
    ordered_json schema{{"type", "object"}};
    for (const Field& field : row.fields) {
      schema["properties"][std::string(field.key)] = SchemaOf(field);
      if (field.required) schema["required"].push_back(field.key);
    }
    schema["properties"][std::string(emulator::kRobotField.key)] = SchemaOf(emulator::kRobotField);
    schema["additionalProperties"] = false;
    const ordered_json body{{"required", schema.contains("required")},
                            {"content", {{"application/json", {{"schema", schema}}}}}};
    text += "  " + RequestPath(row) +
            ":\n    post:\n      tags: [request]\n      summary: " + ordered_json(row.does).dump() +
            "\n      operationId: " + OperationId(row) +
            "\n      security: [{token: []}, {}]\n      requestBody: " + body.dump() +
            "\n      responses: {\"200\": {$ref: \"#/components/responses/Done\"}, default: {$ref: "
            "\"#/components/responses/Error\"}}\n";
  }
  return text;
}

}  // namespace understudy::server
