#include "bus/interfaces.h"

#include <string>

#include <gmock/gmock.h>

#include "base/errors.h"

namespace understudy::bus {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

std::string Complaint(const std::string& name) {
  try {
    FindInterface(name);
  } catch (const BusError& error) {
    return error.what();
  }
  return "";
}

TEST(InterfacesTest, FindsLoopback) {
  const NetworkInterface lo = FindInterface("lo");
  EXPECT_EQ(lo.name, "lo");
  EXPECT_TRUE(lo.up);
  EXPECT_EQ(DdsAddress(lo), "127.0.0.1");
}

TEST(InterfacesTest, TakesTheAddressInARobotsNetworkBeforeOthers) {
  const auto address = [](std::vector<std::string> all) {
    return DdsAddress({.name = "eth0", .addresses = std::move(all)});
  };
  EXPECT_EQ(address({"10.0.0.7", "192.168.123.99"}), "192.168.123.99");
  EXPECT_EQ(address({"192.168.123.99", "192.168.123.161"}), "192.168.123.161");
  EXPECT_EQ(address({"10.0.0.7", "192.168.12.1"}), "10.0.0.7");
}

TEST(InterfacesTest, ListsEachInterfaceOnce) {
  const auto interfaces = ListInterfaces();
  EXPECT_EQ(std::ranges::count(interfaces, "lo", &NetworkInterface::name), 1);
}

TEST(InterfacesTest, NamesTheAbsentOneTheOthersAndTheNearest) {
  EXPECT_THAT(Complaint("lo0"),
              AllOf(HasSubstr("'lo0'"), HasSubstr("valid: "), HasSubstr("did you mean 'lo'?")));
}

TEST(InterfacesTest, RefusesAnEmptyName) { EXPECT_THAT(Complaint(""), HasSubstr("valid: ")); }

}  // namespace
}  // namespace understudy::bus
