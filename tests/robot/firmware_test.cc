#include "robot/firmware.h"

#include <gtest/gtest.h>

namespace understudy::robot {
namespace {

TEST(FirmwareTest, IsNumbersBetweenDots) {
  for (const char* good : {"1", "1.1.6", "8.2.0.0", "10.0"}) EXPECT_TRUE(IsFirmware(good)) << good;
  for (const char* bad : {"", ".", "1.", ".1", "1..2", "1.a", "v1", "999999999"}) {
    EXPECT_FALSE(IsFirmware(bad)) << bad;
  }
}

TEST(FirmwareTest, IsComparedNumberByNumber) {
  EXPECT_TRUE(FirmwareReaches("1.1.6", "1.1.6"));
  EXPECT_TRUE(FirmwareReaches("1.1.10", "1.1.6"));
  EXPECT_TRUE(FirmwareReaches("1.2", "1.1.6"));
  EXPECT_TRUE(FirmwareReaches("1.1", "1.1.0"));
  EXPECT_FALSE(FirmwareReaches("1.1.5", "1.1.6"));
  EXPECT_FALSE(FirmwareReaches("1.1", "1.1.1"));
}

TEST(FirmwareTest, HasAServiceFromItsFirstToBeforeItsLastVersion) {
  ServiceSpec service;
  EXPECT_TRUE(HasService("", service));
  service.since = "1.1";
  service.before = "1.3";
  EXPECT_FALSE(HasService("1.0", service));
  EXPECT_TRUE(HasService("1.1", service));
  EXPECT_TRUE(HasService("1.2.9", service));
  EXPECT_FALSE(HasService("1.3", service));
}

}  // namespace
}  // namespace understudy::robot
