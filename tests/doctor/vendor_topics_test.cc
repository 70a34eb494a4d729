// The table of topics by which the doctor judges what others write and read.
#include <algorithm>
#include <iterator>

#include <gmock/gmock.h>

#include "config/load.h"
#include "config/robot_file.h"
#include "doctor/echo_topics.h"
#include "idl/type_table.h"
#include "services/api_names.h"
#include "wire/robot_topics.h"

namespace understudy::doctor {
namespace {

TEST(VendorTopicsTest, HaveTypesThatTheVendorHas) {
  for (const wire::TopicName& topic : wire::VendorTopics()) {
    EXPECT_THAT(wire::TypesOf(topic.name), testing::Contains(topic.type)) << topic.name;
    EXPECT_NE(FindMessageType(topic.type), nullptr) << topic.name << " " << topic.type;
    EXPECT_FALSE(IsEchoTopic(topic.name));
  }
}

TEST(VendorTopicsTest, HaveWhatOurRobotsReadAndPublish) {
  for (const std::string& name : config::RobotNames(UNDERSTUDY_SOURCE_DIR)) {
    const config::Config config = config::LoadConfig({.robot = name}, UNDERSTUDY_SOURCE_DIR);
    std::vector<wire::RobotTopic> topics = wire::CommandTopics(config.robots[0].spec);
    std::ranges::copy(wire::PublishedTopics(config.robots[0].spec,
                                            services::ServiceNames(config.robots[0].spec.apis)),
                      std::back_inserter(topics));
    for (const wire::RobotTopic& topic : topics) {
      if (topic.name.empty()) continue;
      EXPECT_THAT(wire::TypesOf(topic.name), testing::Contains(topic.type))
          << topic.name << " of " << name;
    }
  }
}

TEST(VendorTopicsTest, HoldTheEchosForNoneOfTheVendors) {
  for (const char* const topic :
       {GoEcho::kPing.name, GoEcho::kPong.name, HgEcho::kPing.name, HgEcho::kPong.name}) {
    EXPECT_TRUE(wire::TypesOf(topic).empty()) << topic;
    EXPECT_TRUE(IsEchoTopic(topic)) << topic;
  }
}

}  // namespace
}  // namespace understudy::doctor
