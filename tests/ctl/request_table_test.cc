// Checks that every request reads the same from JSON, a script and the command line.
#include <cstdio>
#include <sstream>

#include <CLI/CLI.hpp>

#include "base/errors.h"
#include "ctl/command.h"
#include "gtest/gtest.h"
#include "script/script.h"
#include "tests/ctl/fake_robot.h"

namespace understudy::ctl {
namespace {

using emulator::RequestRow;
using nlohmann::json;
using schema::Field;

// A value within the field's range, and one that is none.
json Sound(const Field& field) {
  const schema::Range& range = field.range;
  if (field.type == &schema::kNumber) return range.max / 4;
  if (field.type == &schema::kWhole) return range.max / 2;
  if (field.type == &schema::kVector) return {range.min / 4, 0.5, range.max};
  if (field.type == &schema::kSwitch) return field.otherwise != 1;
  if (field.type == &schema::kWord) return field.words.back();
  if (field.type == &emulator::types::kSpeed) return 0.25;
  if (field.type == &emulator::types::kKeys || field.type == &emulator::types::kMaybeKeys)
    return "L2+B";
  if (field.type == &emulator::types::kJson) return R"({"a":1})";
  if (field.type == &emulator::types::kFile) return "/tmp/a.mcap";
  if (field.type == &emulator::types::kSetting) return "sensors.noise_gain";
  if (field.type == &emulator::types::kValue) return 3.5;
  return "trunk";
}

json Unsound(const Field& field) {
  if (field.type == &schema::kVector) return {0, 1e9, 0};
  if (field.type->has_range()) return 1e9;
  if (field.type == &emulator::types::kBody || field.type == &emulator::types::kName)
    return std::string(99, 'z');
  if (field.type == &emulator::types::kFile) return "/" + std::string(255, 'z');
  if (field.type == &emulator::types::kValue) return std::string(256, 'z');
  return "zzz";
}

json SoundValues(const RequestRow& row) {
  json values = json::object();
  for (const Field& field : row.fields) {
    if (row.name == "push" && field.key == "impulse") continue;  // beside force
    values[std::string(field.key)] = Sound(field);
  }
  return values;
}

std::string ScriptOf(const RequestRow& row, const json& values) {
  return "script: [{at: 1, " + std::string(row.name) + ": " + values.dump() + "}]";
}

// What `understudy` would be called with.
std::vector<std::string> Words(const RequestRow& row, const json& values) {
  std::vector<std::string> words{"understudy", "ctl"};
  std::istringstream name{std::string(row.example)};
  const auto verbs = 1 + std::ranges::count(row.name, '.');
  std::string word;
  for (std::ptrdiff_t i = 0; i < verbs && name >> word; ++i) words.push_back(word);
  const auto add = [&](const json& value) {
    words.push_back(value.is_string() ? value.get<std::string>() : value.dump());
  };
  for (const Field& field : row.fields) {
    const auto value = values.find(std::string(field.key));
    if (value == values.end()) continue;
    if (!field.bare) words.push_back("--" + std::string(field.key));
    if (value->is_array()) {
      for (const json& part : *value) add(part);
    } else {
      add(*value);
    }
  }
  return words;
}

class RequestTableTest : public ::testing::Test {
 protected:
  // Nobody is to be asked, from wherever the tests are run.
  RequestTableTest() { EXPECT_NE(std::freopen("/dev/null", "r", stdin), nullptr); }

  // "" where the command line is taken.
  static std::string Parse(const std::vector<std::string>& words, bool run) {
    CLI::App app;
    std::ostringstream out;
    CtlCommand dut(&app, &out);
    std::vector<const char*> argv;
    for (const std::string& word : words) argv.push_back(word.c_str());
    try {
      app.parse(static_cast<int>(argv.size()), argv.data());
    } catch (const CLI::ParseError& error) {
      return error.what();
    }
    if (run) dut.Run();
    return {};
  }

  test::TemporaryFolder temp_;
  test::ScopedEnv folder_{"UNDERSTUDY_RUNTIME_DIR", temp_.path().string()};
  test::ScopedEnv control_{"UNDERSTUDY_CONTROL", std::nullopt};
};

TEST_F(RequestTableTest, EveryRequestReadsTheSameFromJsonScriptsAndTheCommandLine) {
  const FakeRobot robot(temp_.path() / "one.sock");
  for (const RequestRow& row : emulator::RequestRows()) {
    const json values = SoundValues(row);
    const auto read = emulator::ReadRequest(row, values);
    ASSERT_TRUE(read) << row.name << ": " << read.why();
    const std::string said = emulator::Describe(*read);

    EXPECT_EQ(Parse(Words(row, values), true), "") << row.name;
    EXPECT_EQ(emulator::Describe(robot.last()), said);

    if (row.from == emulator::From::kPeople) continue;
    const auto script =
        script::ReadScript(schema::ParseYaml(ScriptOf(row, values), "s"), signals::RunningNames());
    EXPECT_EQ(emulator::Describe(script.events.front().request), said);
  }
}

TEST_F(RequestTableTest, EveryMistakeIsToldTheSameByJsonScriptsAndTheCommandLine) {
  for (const RequestRow& row : emulator::RequestRows()) {
    for (const Field& field : row.fields) {
      json values = SoundValues(row);
      values[std::string(field.key)] = Unsound(field);
      const std::string why = emulator::ReadRequest(row, values).why();
      EXPECT_TRUE(why.starts_with(std::string(field.key) + ": expected ")) << why;
      // A key that has the name of its request is named once.
      EXPECT_EQ(Parse(Words(row, values), false),
                (field.key == row.name ? "" : std::string(row.name) + ": ") + why);
      if (row.from == emulator::From::kPeople) continue;
      try {
        script::ReadScript(schema::ParseYaml(ScriptOf(row, values), "s"), signals::RunningNames());
        ADD_FAILURE() << row.name << "." << field.key;
      } catch (const ConfigError& error) {
        EXPECT_EQ(error.what(), "s:1: " + std::string(row.name) + ": " + why);
      }
    }
  }
}

}  // namespace
}  // namespace understudy::ctl
