#include "services/robot_services.h"

#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "services/service.h"

namespace understudy::services {
namespace {

std::set<std::string_view> NamesOf(std::string_view robot) {
  std::set<std::string_view> names;
  for (const ServiceTable& table : ServicesOf(robot)) names.insert(table.title);
  return names;
}

TEST(RobotServicesTest, GiveABuildOfARobotTheRobotsServices) {
  EXPECT_EQ(NamesOf("g1_23dof"), NamesOf("g1"));
  EXPECT_EQ(NamesOf("h1_2"), NamesOf("h1"));
  EXPECT_EQ(NamesOf("go2w").count("sport of Go2-W"), 1U);
}

TEST(RobotServicesTest, GiveARobotOfAnotherNameWhatAllHave) {
  const std::set<std::string_view> all = {"motion_switcher", "robot_state of the others", "config"};
  EXPECT_EQ(NamesOf("my_robot"), all);
  EXPECT_EQ(NamesOf("go2000"), all);
}

TEST(RobotServicesTest, HaveEachServiceAndEachApiOnce) {
  for (const std::string_view robot : RobotsWithServices()) {
    std::set<std::string_view> services;
    for (const ServiceTable& table : ServicesOf(robot)) {
      EXPECT_TRUE(services.insert(table.name).second) << robot << " " << table.name;
      std::set<std::int64_t> ids;
      for (const ApiRow& row : table.rows) EXPECT_TRUE(ids.insert(row.id).second) << row.id;
    }
  }
}

TEST(RobotServicesTest, GetOnlySettingsThatHaveAStart) {
  for (const std::string_view robot : RobotsWithServices()) {
    for (const ServiceTable& table : ServicesOf(robot)) {
      const Service service(table);
      for (const ApiRow& row : table.rows) {
        const auto* give = std::get_if<GiveSetting>(&row.effect);
        if (give == nullptr) continue;
        EXPECT_EQ(service.settings().count(give->name), 1U) << table.title << " " << give->name;
      }
    }
  }
}

TEST(ServicesDocTest, IsWhatTheServicesCommandPrints) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/services.md", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, ServicesReference()) << "write it anew: understudy services > docs/services.md";
}

}  // namespace
}  // namespace understudy::services
