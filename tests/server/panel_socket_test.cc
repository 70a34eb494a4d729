#include "server/panel_socket.h"

#include "base/errors.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::server {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

TEST(PanelSocketTest, TakesTheFirstPortThatIsFree) {
  const PanelSocket one("127.0.0.1", 0);
  const PanelSocket two("127.0.0.1", 0);
  EXPECT_GE(one.port(), kFirstPanelPort);
  EXPECT_GT(two.port(), one.port());
  EXPECT_EQ(one.host(), "127.0.0.1:" + std::to_string(one.port()));
}

TEST(PanelSocketTest, BeginsAtThePortOfTheDomain) {
  EXPECT_GE(PanelSocket("127.0.0.1", 0, 200).port(), kFirstPanelPort + 200);
}

TEST(PanelSocketTest, APortInUseIsAnErrorThatNamesIt) {
  const PanelSocket one("127.0.0.1", 0);
  try {
    PanelSocket("127.0.0.1", one.port());
    FAIL();
  } catch (const SocketError& error) {
    EXPECT_THAT(error.what(), HasSubstr("control.port " + std::to_string(one.port())));
    EXPECT_THAT(error.what(), HasSubstr("in use"));
  }
}

TEST(PanelSocketTest, WhatIsNoAddressIsAnErrorThatNamesTheKey) {
  try {
    PanelSocket("lo", 0);
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("control.address: expected an IP address"));
  }
}

TEST(PanelSocketTest, CallsAnAddressAsABrowserWillThoughItWasWrittenOtherwise) {
  try {
    const PanelSocket dut("0:0:0:0:0:0:0:1", 0);
    EXPECT_EQ(dut.address(), "::1");
    EXPECT_THAT(dut.host(), StartsWith("[::1]:"));
  } catch (const SocketError& error) {
    // A machine without IPv6 says whose address it does not have.
    EXPECT_THAT(error.what(), HasSubstr("control.address 0:0:0:0:0:0:0:1"));
  }
}

TEST(PanelSocketTest, TellsABrowserOfThisMachineWhereToGo) {
  EXPECT_THAT(PanelSocket("0.0.0.0", 0).host(), StartsWith("127.0.0.1:"));
}

}  // namespace
}  // namespace understudy::server
