#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/service.h"
#include "tests/services/services_fixture.h"

namespace understudy::services {
namespace {

using std::chrono::milliseconds;

constexpr char kName[] = R"({"name":"host/sport/1"})";

std::int64_t IdIn(const ServiceReply& reply) {
  return nlohmann::json::parse(reply.data).at("id").get<std::int64_t>();
}

TEST(LeaseTest, IsGivenToTheFirstWithItsTerm) {
  Lease lease;
  const ServiceReply reply = lease.Answer(101, kName, 0, milliseconds(5));
  EXPECT_EQ(reply.code, 0);
  EXPECT_NE(IdIn(reply), 0);
  EXPECT_EQ(nlohmann::json::parse(reply.data).at("term"), 1000000);
}

TEST(LeaseTest, IsRefusedToTheSecond) {
  Lease lease;
  lease.Answer(101, kName, 0, milliseconds(5));
  EXPECT_EQ(lease.Answer(101, kName, 0, milliseconds(6)).code, 3207);
}

TEST(LeaseTest, LastsAsLongAsItIsRenewed) {
  Lease lease;
  const std::int64_t id = IdIn(lease.Answer(101, kName, 0, milliseconds(0)));
  for (int ms = 300; ms <= 3000; ms += 300) {
    EXPECT_EQ(lease.Answer(102, "{}", id, milliseconds(ms)).code, 0);
  }
  EXPECT_EQ(lease.Answer(101, kName, 0, milliseconds(3900)).code, 3207);
}

TEST(LeaseTest, IsOverAfterItsTerm) {
  Lease lease;
  const std::int64_t first = IdIn(lease.Answer(101, kName, 0, milliseconds(0)));
  EXPECT_EQ(lease.Answer(102, "{}", first, milliseconds(1001)).code, 3206);
  const std::int64_t second = IdIn(lease.Answer(101, kName, 0, milliseconds(1001)));
  EXPECT_NE(first, second);
  EXPECT_EQ(lease.Answer(102, "{}", first, milliseconds(1002)).code, 3206);
}

TEST(LeaseTest, CannotBeRenewedByWhoNeverHadOne) {
  EXPECT_EQ(Lease().Answer(102, "{}", 0, milliseconds(0)).code, 3206);
}

TEST(LeaseTest, RefusesAnApplicationThatIsNoJson) {
  EXPECT_EQ(Lease().Answer(101, "{", 0, milliseconds(0)).code, 3204);
  EXPECT_EQ(Lease().Answer(101, "{}", 0, milliseconds(0)).code, 0);
  EXPECT_EQ(Lease().Answer(103, "{}", 0, milliseconds(0)).code, 3203);
}

TEST(LeaseTest, KeepsOthersFromCommandingButNotFromAsking) {
  Caller caller(TableOf("go2", "sport"));
  const std::int64_t id = IdIn(caller.service.lease().Answer(101, kName, 0, caller.now));
  EXPECT_EQ(caller.Ask(1004).code, 3205);
  EXPECT_EQ(caller.Ask(1004, "", id + 1).code, 3205);
  EXPECT_EQ(caller.Ask(1004, "", id).code, 0);
  EXPECT_EQ(caller.Ask(2055).code, 0);
  EXPECT_EQ(caller.Ask(1).data, "1.0.0.1");
  caller.now += milliseconds(1001);
  EXPECT_EQ(caller.Ask(1004).code, 0);
  EXPECT_EQ(caller.Ask(1004, "", id).code, 3205);
}

}  // namespace
}  // namespace understudy::services
