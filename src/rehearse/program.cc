#include "rehearse/program.h"

#include <string_view>

#include "base/errors.h"
#include "rehearse/yaml_values.h"
#include "schema/field.h"

namespace understudy::rehearse {
namespace {

using schema::Field;
using schema::kNumber;
using schema::kTree;
using schema::YamlValue;
using Kind = YamlValue::Kind;

constexpr double kLongestProgram = 600;  // s of a program that nothing else ends; *assumed*

constexpr std::string_view kEnds[] = {"term", "kill"};
constexpr schema::Range kTimes{0, kLatestTime};
constexpr Field kProgramKeys[] = {
    {"command",
     &kTree,
     "",
     {},
     "Program and arguments; `-- CMD...` replaces it",
     "a list of words"},
    {"at", &kNumber, "s", kTimes, "When it starts; 0 unless given"},
    {"until", &kNumber, "s", kTimes, "When it is ended; it ends by itself unless given"},
    {.key = "by",
     .type = &schema::kWord,
     .does = "How: SIGTERM, and SIGKILL 0.5 s later, unless given; or SIGKILL",
     .words = kEnds},
    {"limit", &kNumber, "s", kTimes,
     "From its start, in which it has to end by itself: an expectation like the others; 600 unless "
     "given, and none beside `until` or `duration`"},
    {"think",
     &kNumber,
     "s",
     {.min = 0, .max = 1},
     "From the end of a sleep to its next message, with `clock: simulated`; 0 unless given"},
};

}  // namespace

Program ReadProgram(const YamlValue& value) {
  if (value.kind == Kind::kNull) return {};
  if (value.kind != Kind::kMap) {
    Refuse(value, "program", "a mapping, as in {command: [python3, walk.py, lo]}");
  }
  const schema::Mapping keys(value, kProgramKeys, "program.");
  Program program;
  if (const YamlValue* command = value.Find("command")) {
    if (command->kind != Kind::kSequence || command->items.empty()) {
      Refuse(*command, "program.command", "a list of words, as in [python3, walk.py, lo]");
    }
    for (const YamlValue& word : command->items) {
      if (word.kind != Kind::kScalar) Refuse(word, "program.command", "a word");
      program.command.push_back(word.text);
    }
  }
  if (const auto at = keys.Take("at")) program.at = at->number;
  if (const auto until = keys.Take("until")) program.until = until->number;
  if (program.until && *program.until < program.at) {
    throw ConfigError(value.Find("until")->where +
                      ": program.until: it would end before it starts");
  }
  if (const auto limit = keys.Take("limit")) program.limit = limit->number;
  if (const auto by = keys.Take("by")) program.kill = by->text == "kill";
  if (const auto think = keys.Take("think")) program.think = think->number;
  return program;
}

std::optional<double> LimitOf(const Program& program, const config::Config& config) {
  if (program.limit || program.until || config.time.duration > 0) return program.limit;
  return kLongestProgram;
}

std::string ProgramReference() { return schema::MarkdownRows(kProgramKeys, "program."); }

}  // namespace understudy::rehearse
