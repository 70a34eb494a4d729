#include "services/robot_services.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <set>

#include <gtest/gtest.h>

#include "base/errors.h"
#include "services/api_names.h"
#include "services/service.h"
#include "services/service_host.h"
#include "tests/support/new_domain.h"
#include "tests/support/robots.h"
#include "wire/port.h"

namespace understudy::services {
namespace {

TEST(RobotServicesTest, GiveARobotTheTablesThatItsFileNames) {
  const std::vector<ServiceTable> tables = ServicesOf({"config", "sport_go2w"});
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].title, "config");
  EXPECT_EQ(tables[1].title, "sport of Go2-W");
}

TEST(RobotServicesTest, GiveABuildOfARobotTheRobotsServices) {
  EXPECT_EQ(test::ShippedRobot("g1_23dof").apis, test::ShippedRobot("g1").apis);
}

TEST(RobotServicesTest, GiveARobotThatNamesNoneWhatAllHave) {
  std::set<std::string_view> titles;
  for (const ServiceTable& table : ServicesOf(robot::RobotSpec{}.apis)) titles.insert(table.title);
  EXPECT_EQ(titles, (std::set<std::string_view>{"motion_switcher", "robot_state", "config"}));
}

TEST(RobotServicesTest, RefuseTwoVariantsOfOneService) {
  EXPECT_THROW(ServicesOf({"sport_go2", "sport_b2"}), ConfigError);
  EXPECT_THROW(ServicesOf({"config", "config"}), ConfigError);
}

TEST(RobotServicesTest, AreThereForEachRobot) {
  for (const std::string& robot : test::Robots()) {
    EXPECT_NO_THROW(ServicesOf(test::ShippedRobot(robot).apis)) << robot;
  }
}

TEST(RobotServicesTest, AreNamedAsTheirTablesAre) {
  for (const std::string_view name : kApiNames) {
    EXPECT_EQ(ServiceNames({std::string(name)}),
              std::vector<std::string>{std::string(TableNamed(name).name)});
  }
}

// What faults and conditions know without a bus is what there is on the bus.
TEST(RobotServicesTest, PublishWithTheirRobotInOneList) {
  for (const std::string& name : test::Robots()) {
    const robot::RobotSpec spec = test::ShippedRobot(name);
    const bus::Participant participant("lo", test::NewDomain());
    wire::Port port(participant, spec, 0.001);
    const ServiceHost host(
        participant, &port.outlets(), ServicesOf(spec.apis), [](auto&) {}, spec.status_texts);
    std::vector<std::string> opened, listed, said = port.topics();
    for (std::size_t i = 0; i < port.outlets().size(); ++i) {
      opened.push_back(port.outlets()[i].topic().name);
    }
    for (const wire::RobotTopic& topic : wire::PublishedTopics(spec, ServiceNames(spec.apis))) {
      listed.push_back(topic.name);
    }
    std::ranges::copy(host.topics(), std::back_inserter(said));
    EXPECT_EQ(opened, listed) << name;
    EXPECT_EQ(opened, said) << name;
    EXPECT_EQ(std::set<std::string>(opened.begin(), opened.end()).size(), opened.size()) << name;
  }
}

TEST(RobotServicesTest, HaveEachApiOnce) {
  for (const std::string_view name : kApiNames) {
    std::set<std::int64_t> ids;
    for (const ApiRow& row : TableNamed(name).rows) {
      EXPECT_TRUE(ids.insert(row.id).second) << name << " " << row.id;
    }
  }
}

TEST(RobotServicesTest, GetOnlySettingsThatHaveAStart) {
  for (const std::string_view name : kApiNames) {
    const ServiceTable table = TableNamed(name);
    const Service service(table);
    for (const ApiRow& row : table.rows) {
      const auto* give = std::get_if<GiveSetting>(&row.effect);
      if (give == nullptr) continue;
      EXPECT_EQ(service.settings().count(give->name), 1U) << table.title << " " << give->name;
    }
  }
}

TEST(ServicesDocTest, IsWhatTheServicesCommandPrints) {
  std::ifstream file(UNDERSTUDY_SOURCE_DIR "/docs/reference/services.md", std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_EQ(text, ServicesReference())
      << "write it anew: understudy services > docs/reference/services.md";
}

}  // namespace
}  // namespace understudy::services
