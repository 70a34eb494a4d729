#include "server/request_docs.h"

#include <algorithm>
#include <array>
#include <vector>

#include "config/reference.h"
#include "emulator/live_settings.h"

namespace understudy::server {
namespace {

using emulator::RequestRow;
using nlohmann::ordered_json;
using schema::Field;
using schema::NumberText;

constexpr std::string_view kHead =
    "# Requests\n\n"
    "Written by `understudy requests > docs/reference/requests.md` from the table that carries "
    "them out.\n\n"
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
    "beside the values is the number of the one that is meant, from 0; a run has number 0 "
    "alone.\n\n"
    "| request | value | takes | default | meaning |\n|---|---|---|---|---|\n";

constexpr std::string_view kFoot =
    "\nKeys: R1 L1 START SELECT R2 L2 F1 F2 A B X Y UP RIGHT DOWN LEFT, joined by `+`. What chords "
    "do stands in the robot's YAML, `robot.remote.chords`. The remote controller is there from its "
    "first request on.\n";

std::string DefaultOf(const Field& field) {
  if (field.required) return "needed";
  if (!field.otherwise) return "";
  if (field.type == &schema::kSwitch) return *field.otherwise != 0 ? "on" : "off";
  if (field.type != &schema::kVector) return NumberText(*field.otherwise);
  const std::string number = NumberText(*field.otherwise);
  return number + " " + number + " " + number;
}

constexpr std::array<std::string_view, 3> kFrom = {"both", "people", "script"};
static_assert(kFrom.size() == static_cast<std::size_t>(emulator::From::kScript) + 1);

ordered_json FieldJson(const Field& field) {
  ordered_json json{{"key", field.key}, {"kind", field.type->name}};
  if (!field.unit.empty()) json["unit"] = field.unit;
  if (field.type->has_range()) json["range"] = {field.range.min, field.range.max};
  if (!field.words.empty()) json["words"] = field.words;
  if (field.otherwise) json["default"] = *field.otherwise;
  json["required"] = field.required;
  json["does"] = field.does;
  return json;
}

// The schema of OpenAPI of what a field takes, without its description.
ordered_json TypeSchemaOf(const Field& field) {
  if (field.type == &emulator::types::kSpeed) {
    return {{"oneOf",
             {{{"type", "number"}, {"minimum", 0.001}, {"maximum", 1000}},
              {{"type", "string"}, {"enum", {"max"}}}}}};
  }
  if (field.type == &emulator::types::kValue) {
    return {{"oneOf", {{{"type", "number"}}, {{"type", "boolean"}}, {{"type", "string"}}}}};
  }
  if (field.type == &emulator::types::kSetting) {
    std::vector<std::string_view> keys;
    for (const emulator::LiveSetting& one : emulator::LiveSettings()) keys.push_back(one.key);
    return {{"type", "string"}, {"enum", keys}};
  }
  if (field.type == &schema::kVector) {
    const ordered_json number = TypeSchemaOf(schema::ItemOf(field));
    return {{"type", "array"}, {"items", number}, {"minItems", 3}, {"maxItems", 3}};
  }
  ordered_json schema{{"type", field.type == &schema::kWhole    ? "integer"
                               : field.type == &schema::kSwitch ? "boolean"
                               : field.type->is_text()          ? "string"
                                                                : "number"}};
  if (!field.words.empty()) schema["enum"] = field.words;
  if (field.type->has_range()) {
    schema["minimum"] = field.range.min;
    schema["maximum"] = field.range.max;
  }
  if (field.otherwise) schema["default"] = *field.otherwise;
  if (field.otherwise && field.type == &schema::kSwitch) schema["default"] = *field.otherwise != 0;
  return schema;
}

ordered_json SchemaOf(const Field& field) {
  ordered_json schema = TypeSchemaOf(field);
  const std::string unit = field.unit.empty() ? "" : std::string(field.unit) + ". ";
  schema["description"] = unit + std::string(field.does);
  return schema;
}

// The settings that `set` changes, and why others cannot be.
std::string SettingsReference() {
  std::string text =
      "\n## Settings\n\nWhat `set` changes, and `ctl set` and `GET /settings` list with their "
      "values. Units and ranges are those of [the configuration](config.md). A value holds from "
      "the next step on and over resets; the event `setting` reports it, also in recordings.\n\n"
      "| key | takes | meaning |\n|---|---|---|\n";
  for (const schema::Entry& key : config::SettingKeys()) {
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
      text += "| | `" + key + "` | " + schema::Expected(field) + " | " + DefaultOf(field) + " | " +
              std::string(field.does) + " |\n";
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
