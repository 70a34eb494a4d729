#include "authority/onboard.h"

#include <gmock/gmock.h>

namespace understudy::authority {
namespace {

using ::testing::ElementsAre;

robot::RobotSpec Dog(const char* firmware) {
  robot::RobotSpec spec;
  spec.firmware = firmware;
  const auto add = [&](const char* name, const char* alias, const char* since, const char* before) {
    spec.services.push_back({.name = name, .alias = alias, .since = since, .before = before});
  };
  add("mcf", "mcf", "1.1.6", "");
  add("sport_mode", "normal", "", "1.1.6");
  add("ai_sport", "ai", "", "1.1.6");
  add("vui_service", "", "", "");
  return spec;
}

TEST(OnboardTest, HasTheServicesOfItsFirmware) {
  EXPECT_THAT(MotionServices(Dog("1.1.6")), ElementsAre("mcf"));
  EXPECT_THAT(MotionServices(Dog("1.1.5")), ElementsAre("normal", "ai"));
  EXPECT_EQ(OnboardServices(Dog("1.1.6"), "mcf").size(), 2U);
}

TEST(OnboardTest, BeginsWithTheFirstUnlessToldOtherwise) {
  EXPECT_EQ(StartService(Dog("1.1.5"), {}), "normal");
  EXPECT_EQ(StartService(Dog("1.1.5"), {.service = "ai"}), "ai");
  EXPECT_EQ(StartService(Dog("1.1.5"), {.service = kNoService}), "");
  EXPECT_EQ(StartService({}, {}), "");
}

TEST(OnboardTest, SwitchesOneMotionServiceOnAndTheOthersAsDescribed) {
  const auto services = OnboardServices(Dog("1.1.5"), "ai");
  ASSERT_EQ(services.size(), 3U);
  EXPECT_FALSE(services[0].on);
  EXPECT_TRUE(services[1].on);
  EXPECT_TRUE(services[2].on);
}

}  // namespace
}  // namespace understudy::authority
