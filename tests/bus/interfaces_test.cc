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
  EXPECT_TRUE(lo.ipv4);
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
