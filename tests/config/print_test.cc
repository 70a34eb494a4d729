#include <map>
#include <set>

#include "config/keys.h"
#include "config/reference.h"
#include "config_fixture.h"
#include "schema/printer.h"

namespace understudy::config {
namespace {

using testing::HasSubstr;

const std::filesystem::path kSource = UNDERSTUDY_SOURCE_DIR;

class PrintConfigTest : public ConfigFixture {
 protected:
  // The printed configuration of a robot of ours, loaded again over that robot and printed.
  std::string Again(const std::string& robot, const std::string& printed) {
    const std::string file = Write("printed.yaml", printed);
    return PrintConfig(LoadConfig({.robot = robot, .files = {file}}, kSource), false);
  }
};

// Every value by its key, as text; of lists those of all elements.
class Collector : public schema::Archive {
 public:
  std::map<std::string, std::set<std::string>> values;

 protected:
  void Visit(const schema::Field& field, const schema::Slot& slot) override {
    values[path_ + std::string(field.key)].insert(ValueText(field, slot));
  }
  void VisitList(const schema::Field& field, const schema::ListSlot& slot) override {
    const std::string outer = path_;
    path_ += std::string(field.key) + "[].";
    if (slot.size() == 0) slot.describe_blank();
    for (std::size_t i = 0; i < slot.size(); ++i) slot.describe(i);
    path_ = outer;
  }
  bool Enter(const schema::Field& field, std::string_view) override {
    outer_.push_back(path_);
    path_ += std::string(field.key) + ".";
    return true;
  }
  void Leave() override {
    path_ = outer_.back();
    outer_.pop_back();
  }

 private:
  std::string path_;
  std::vector<std::string> outer_;
};

std::map<std::string, std::set<std::string>> Values(Config config) {
  Collector collector;
  Describe(collector, config);
  return collector.values;
}

TEST_F(PrintConfigTest, ReadsBackAsTheSameForEachRobot) {
  for (const std::string& robot : RobotNames(kSource)) {
    const Config config = LoadConfig({.robot = robot}, kSource);
    const std::string printed = PrintConfig(config, false);
    EXPECT_EQ(Again(robot, printed), printed);
    EXPECT_EQ(Again(robot, PrintConfig(config, true)), printed);
  }
}

TEST_F(PrintConfigTest, ReadsBackAsTheSameForEachRevision) {
  for (const std::string robot : {"g1", "g1_23dof"}) {
    for (const std::string& revision : ReadRobotFile(robot, kSource).RevisionNames()) {
      const Config config = LoadConfig(
          {.robot = robot, .files = {}, .sets = {"robot.revision=" + revision}}, kSource);
      EXPECT_EQ(config.robots[0].spec.revision, revision);
      const std::string printed = PrintConfig(config, false);
      EXPECT_EQ(Again(robot, printed), printed) << robot << " " << revision;
      EXPECT_EQ(Again(Write("robot.yaml", printed), "{}"), printed) << robot << " " << revision;
    }
  }
}

TEST_F(PrintConfigTest, ReadsBackAsTheSameWithAnyHands) {
  for (const std::string make : {"dex1", "dex1_old", "inspire", "brainco", "inspire_ftp", "none",
                                 "left:inspire,right:dex3"}) {
    const Config config = LoadConfig({.robot = "g1", .sets = {"robot.hand_make=" + make}}, kSource);
    const std::string printed = PrintConfig(config, false);
    EXPECT_EQ(Again("g1", printed), printed) << make;
    EXPECT_EQ(Again(Write("robot.yaml", printed), "{}"), printed) << make;
  }
}

TEST_F(PrintConfigTest, ReadsBackAsTheSameForEachFirmware) {
  for (const std::string robot : {"g1", "go2"}) {
    for (const std::string& firmware : ReadRobotFile(robot, kSource).FirmwareNames()) {
      const Config config = LoadConfig(
          {.robot = robot, .files = {}, .sets = {"robot.firmware='" + firmware + "'"}}, kSource);
      EXPECT_EQ(config.robots[0].spec.firmware, firmware);
      const std::string printed = PrintConfig(config, false);
      EXPECT_EQ(Again(robot, printed), printed) << robot << " " << firmware;
      EXPECT_EQ(Again(Write("robot.yaml", printed), "{}"), printed) << robot << " " << firmware;
    }
  }
}

TEST_F(PrintConfigTest, ReadsBackAsTheSameWithEveryKeyChanged) {
  const std::string all = (kSource / "tests/config/data/one_of_everything.yaml").string();
  const Config config = LoadConfig({.robot = "g1", .files = {all}}, kSource);
  const std::string printed = PrintConfig(config, false);
  EXPECT_EQ(Again("g1", printed), printed);
  EXPECT_EQ(Again("g1", PrintConfig(config, true)), printed);
  EXPECT_EQ(config.robots[0].spec.description, "a \"robot\" with \\ and é: #1");
  EXPECT_EQ(config.robots[0].spec.standing.q[0], 0.30000000000000004);
}

TEST_F(PrintConfigTest, ChangesEveryKeyInOneOfEverything) {
  const std::string all = (kSource / "tests/config/data/one_of_everything.yaml").string();
  const auto changed = Values(LoadConfig({.robot = "g1", .files = {all}}, kSource));
  const auto defaults = Values(Config{});
  EXPECT_EQ(changed.size(), ConfigKeys().size());
  for (const auto& [key, value] : changed) EXPECT_NE(value, defaults.at(key)) << key;
}

TEST_F(PrintConfigTest, WritesOneLinePerKeyAndPerElement) {
  const std::string text = PrintConfig(LoadText("gate: lenient\n"), false);
  EXPECT_THAT(text, HasSubstr("\ngate:\n  mode: lenient\n  timeout: 0.2\n"));
  EXPECT_THAT(text, HasSubstr("\n  motors:\n    - {joint: a, slot: 0, torque_limit: 10, "));
  EXPECT_EQ(text.find('#'), std::string::npos);
}

TEST_F(PrintConfigTest, WritesListsWithinAnElementOnItsLine) {
  const Config config = LoadText(
      "robot: {family: hg, hands: [{name: left, topic: left,\n"
      "  motors: [{joint: u, torque_limit: 1}, {joint: v, torque_limit: 2}]}]}\n");
  EXPECT_THAT(
      PrintConfig(config, false),
      testing::AllOf(HasSubstr("\n  hands:\n    - {name: left, law: dex3, models: [], topic: left, "
                               "hz: 500, motors: [{joint: u, "),
                     HasSubstr(", hold_kd: 0}, {joint: v, ")));
  EXPECT_THAT(PrintConfig(config, true),
              HasSubstr("    # motors: Its motors, in the order of the messages\n"
                        "      # joint: Joint of the model that it drives [text]\n"));
}

TEST_F(PrintConfigTest, ExplainsKeysInComments) {
  EXPECT_THAT(PrintConfig(LoadText(""), true),
              HasSubstr("    # Rate of all rt/lf topics [Hz; 1 to 10000]\n    lf_hz: 20\n"));
}

}  // namespace
}  // namespace understudy::config
