#include "config/profile.h"

#include <algorithm>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include "config/reference.h"
#include "config_fixture.h"

namespace understudy::config {
namespace {

const std::filesystem::path kSource = UNDERSTUDY_SOURCE_DIR;

class ProfileTest : public ConfigFixture {
 protected:
  ProfileTest() {
    Write("config/profiles/nominal.yaml", "sensors: {imu: {gyro_bias: 1, gyro_walk: 1}}\n");
    Write("config/profiles/worn.yaml", "sensors: {imu: {gyro_bias: 2, gyro_walk: 2}}\n");
  }
};

TEST_F(ProfileTest, IsTheUsualOneWhereNothingAsksForOne) {
  const Config config = Load({});
  EXPECT_EQ(config.robots[0].profile, "nominal");
  EXPECT_EQ(config.robots[0].sensors.imu.gyro_bias, 1);
  EXPECT_EQ(Load({}, {"profile=''"}).robots[0].profile, "nominal");
}

TEST_F(ProfileTest, LiesAboveTheRobotsFileAndBelowWhatTheUserSays) {
  Write("config/robots/tiny.yaml",
        std::string(test::kTinyRobot) +
            "sensors: {imu: {gyro_bias: 5, gyro_walk: 5, accel_bias: 5}}\n");
  const std::string file = Write("run.yaml", "sensors: {imu: {gyro_walk: 7}}\n");
  const Config config = Load({file}, {"profile=worn", "sensors.imu.accel_walk=0.5"});
  EXPECT_EQ(config.robots[0].profile, "worn");
  EXPECT_EQ(config.robots[0].sensors.imu.gyro_bias, 2);
  EXPECT_EQ(config.robots[0].sensors.imu.gyro_walk, 7);
  EXPECT_EQ(config.robots[0].sensors.imu.accel_bias, 5);
  EXPECT_EQ(config.robots[0].sensors.imu.accel_walk, 0.5);
  EXPECT_EQ(Load({}, {"sensors.imu.gyro_bias=0", "profile=worn"}).robots[0].sensors.imu.gyro_bias,
            0)
      << "whatever their order";
}

TEST_F(ProfileTest, LiesBelowARobotsFileThatDoesNotLeaveItToTheUser) {
  Write("config/robots/tiny.yaml",
        std::string(test::kTinyRobot) + "profile: worn\nsensors: {imu: {gyro_bias: 5}}\n");
  const Config config = Load({});
  EXPECT_EQ(config.robots[0].profile, "worn");
  EXPECT_EQ(config.robots[0].sensors.imu.gyro_bias, 5);
  EXPECT_EQ(config.robots[0].sensors.imu.gyro_walk, 2);
  EXPECT_EQ(Load({}, {"profile=nominal"}).robots[0].sensors.imu.gyro_bias, 1);
}

TEST_F(ProfileTest, IsTheOneThatTheLastLayerAsksFor) {
  const std::string file = Write("run.yaml", "profile: worn\n");
  EXPECT_EQ(Load({file}).robots[0].profile, "worn");
  EXPECT_EQ(Load({file}, {"profile=nominal"}).robots[0].sensors.imu.gyro_bias, 1);
}

TEST_F(ProfileTest, OfAnUnknownNameIsRefusedWithTheNearest) {
  EXPECT_EQ(SetError("profile=worm"),
            "--set profile=worm: profile: no profile 'worm'; did you mean 'worn'? "
            "(valid: nominal, worn)");
  EXPECT_EQ(FileError("gate:\nprofile: ../robots/tiny\n"),
            "run.yaml:2: profile: no profile '../robots/tiny'; valid: nominal, worn");
  EXPECT_EQ(FileError("profile: [worn]\n"),
            "run.yaml:1: profile: expected one line of text, got a list");
}

TEST_F(ProfileTest, IsNoneWhereThereAreNone) {
  std::filesystem::remove_all(directory_ / "config/profiles");
  EXPECT_EQ(Load({}).robots[0].profile, "");
  EXPECT_NE(SetError("profile=worn"), "");
}

TEST(ProfilesTest, AreFourAndSayEachValueOfTheSensors) {
  EXPECT_EQ(ProfileNames(kSource), (std::vector<std::string>{"harsh", "ideal", "nominal", "worn"}));
  for (const std::string& name : ProfileNames(kSource)) {
    const YamlValue tree = ReadYamlFile(kSource / "config/profiles" / (name + ".yaml"));
    for (const std::string& key : ConfigKeys()) {
      if (!key.starts_with("sensors.") || key == "sensors.seed") continue;
      const YamlValue* value = &tree;
      for (std::size_t at = 0; value != nullptr && at < key.size();) {
        const std::size_t dot = std::min(key.find('.', at), key.size());
        value = value->Find(key.substr(at, dot - at));
        at = dot + 1;
      }
      EXPECT_NE(value, nullptr) << name << " " << key;
    }
  }
}

// The comments of a profile by key: what is behind # on its line, and on those below that have
// nothing else.
std::map<std::string, std::string> CommentsOf(const std::string& profile) {
  std::map<std::string, std::string> comments;
  std::string group, key;
  std::ifstream file(kSource / "config/profiles" / (profile + ".yaml"));
  for (std::string line; std::getline(file, line);) {
    std::smatch parts;
    if (std::regex_match(line, parts, std::regex("( *)([a-z_]+):(.*)"))) {
      const std::string rest = parts[3];
      if (rest.empty()) {
        group = parts[1].length() == 0 ? "" : std::string(parts[2]) + ".";
        continue;
      }
      key = (parts[1].length() == 2 ? "" : group) + std::string(parts[2]);
      const std::size_t comment = rest.find('#');
      comments[key] = comment == std::string::npos ? "" : rest.substr(comment);
    } else if (!key.empty()) {
      comments[key] += line;
    }
  }
  return comments;
}

TEST(ProfilesTest, SayTheUnitAndTheSourceOfEachValue) {
  const std::string grades = "assumed|derived|measured|vendor|no figure is published";
  const std::map<std::string, std::string> others = {
      {"nominal", ""},
      {"worn", "|as nominal"},
      {"harsh", "|as nominal"},
      {"ideal", "|none|no end|no error|not used|the truth|warm|of nothing"}};
  const std::set<std::string> without_unit = {"quantise", "noise", "imu.saturate", "imu.attitude",
                                              "odometer.legs"};
  for (const auto& [profile, more] : others) {
    const std::map<std::string, std::string> comments = CommentsOf(profile);
    EXPECT_GT(comments.size(), 20U);
    for (const auto& [key, comment] : comments) {
      EXPECT_TRUE(std::regex_search(comment, std::regex(grades + more)))
          << profile << " " << key << ": " << comment;
      if (without_unit.contains(key)) continue;
      EXPECT_TRUE(std::regex_search(
          comment, std::regex("# (times|share|s|Hz|N|m|rad|°C|1/s|1/s²|rad/s|m/s²|N/√s|m/√s|"
                              "rad/s/√s|m/s²/√s); ")))
          << profile << " " << key << ": " << comment;
    }
  }
}

// docs/reference/fidelity.md says which keys of nominal.yaml are not: all others are assumed.
TEST(ProfilesTest, AreAssumedWhereTheListOfAllThatIsSaysSo) {
  std::ifstream file(kSource / "docs/reference/fidelity.md");
  std::string row;
  while (std::getline(file, row) && !row.starts_with("| `nominal.yaml` |")) continue;
  ASSERT_FALSE(row.empty());
  for (const auto& [key, comment] : CommentsOf("nominal")) {
    const bool assumed = comment.find("assumed") != std::string::npos ||
                         comment.find("no figure is published") != std::string::npos;
    EXPECT_NE(assumed, row.find("`" + key + "`") != std::string::npos) << key << comment;
  }
}

TEST(ProfilesTest, ErrMoreFromOneToTheNext) {
  const auto sensors = [](const std::string& profile) {
    return LoadConfig({.robot = "go2", .files = {}, .sets = {"profile=" + profile}}, kSource)
        .robots[0]
        .sensors;
  };
  const sensors::SensorConfig ideal = sensors("ideal"), nominal = sensors("nominal"),
                              worn = sensors("worn"), harsh = sensors("harsh");
  EXPECT_FALSE(ideal.noise);
  EXPECT_TRUE(ideal.quantise);
  EXPECT_EQ(ideal.imu.attitude, sensors::AttitudeSource::kTruth);
  EXPECT_FALSE(ideal.imu.saturate);
  const auto rises = [&](auto of) {
    EXPECT_EQ(of(ideal), 0);
    EXPECT_LT(of(ideal), of(nominal));
    EXPECT_LT(of(nominal), of(worn));
    EXPECT_LT(of(worn), of(harsh));
  };
  using S = const sensors::SensorConfig&;
  rises([](S s) { return s.imu.gyro_bias; });
  rises([](S s) { return s.imu.gyro_walk; });
  rises([](S s) { return s.imu.gyro_scale; });
  rises([](S s) { return s.imu.gyro_misalignment; });
  rises([](S s) { return s.imu.accel_bias; });
  rises([](S s) { return s.imu.accel_walk; });
  rises([](S s) { return s.imu.accel_scale; });
  rises([](S s) { return s.imu.accel_misalignment; });
  rises([](S s) { return s.encoder.zero; });
  rises([](S s) { return s.foot.offset; });
  rises([](S s) { return s.foot.walk; });
  rises([](S s) { return s.foot.scale; });
  rises([](S s) { return s.foot.cross_talk; });
  rises([](S s) { return s.odometer.scale; });
  rises([](S s) { return s.odometer.walk; });
  rises([](S s) { return s.odometer.shortfall; });
  rises([](S s) { return s.odometer.turn; });
  rises([](S s) { return s.thermometer.time_constant; });
  rises([](S s) { return s.thermometer.offset_c; });
}

}  // namespace
}  // namespace understudy::config
