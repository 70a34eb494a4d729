#include "bus/participant.h"

#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "bus/reader.h"
#include "bus/writer.h"
#include "idl/std_msgs.h"
#include "tests/bus/stranger.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::HasSubstr;

constexpr Topic<std_msgs_msg_dds__String_> kText{"rt/text", &std_msgs_msg_dds__String__desc};

std::string Complaint(const std::string& interface, int domain) {
  try {
    const Participant participant(interface, domain);
  } catch (const BusError& error) {
    return error.what();
  }
  return "";
}

TEST(ParticipantTest, TellsWhereItIs) {
  const int domain = test::NewDomain();
  const Participant participant("lo", domain);
  EXPECT_EQ(participant.interface(), "lo");
  EXPECT_EQ(participant.domain(), domain);
  EXPECT_EQ(participant.multicast(), FindInterface("lo").multicast);
  EXPECT_NE(participant.key(), ParticipantKey{});
}

TEST(ParticipantTest, RefusesAnAbsentInterface) {
  EXPECT_THAT(Complaint("nope0", test::NewDomain()), HasSubstr("no network interface 'nope0'"));
}

TEST(ParticipantTest, RefusesADomainOutOfRange) {
  EXPECT_THAT(Complaint("lo", -1), HasSubstr("out of range: 0..232"));
  EXPECT_THAT(Complaint("lo", kLastDomain + 1), HasSubstr("out of range: 0..232"));
}

TEST(ParticipantTest, JoinsTheLastDomain) { EXPECT_EQ(Complaint("lo", kLastDomain), ""); }

TEST(ParticipantTest, MeetsAnotherOfItsProcessInItsDomain) {
  const int domain = test::NewDomain();
  const Participant first("lo", domain), second("lo", domain), elsewhere("lo", test::NewDomain());
  EXPECT_NE(first.key(), second.key());
  const Writer<std_msgs_msg_dds__String_> writer(first, kText);
  EXPECT_TRUE(test::Eventually([&] { return Reader(second, kText).matched_writers() == 1; }));
  EXPECT_EQ(Reader(elsewhere, kText).matched_writers(), 0);
}

TEST(ParticipantTest, MeetsOnlyThoseOfItsPartition) {
  const int domain = test::NewDomain();
  const Participant left("lo", domain, "", "left"), right("lo", domain, "", "right"),
      program("lo", domain, "", "left"), usual("lo", domain);
  const Writer<std_msgs_msg_dds__String_> writer(left, kText);
  const Reader same(program, kText), other(right, kText), none(usual, kText);
  EXPECT_TRUE(test::Eventually([&] { return same.matched_writers() == 1; }));
  EXPECT_EQ(other.matched_writers(), 0);
  EXPECT_EQ(none.matched_writers(), 0);
}

TEST(ParticipantTest, LeavesItsDomainForTheNext) {
  const int domain = test::NewDomain();
  { const Participant first("lo", domain); }
  EXPECT_EQ(Complaint("lo", domain), "");
}

TEST(ParticipantTest, DoesNotReadCycloneddsUri) {
  ASSERT_EQ(setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>", 1),
            0);
  EXPECT_EQ(Complaint("lo", test::NewDomain()), "");
  unsetenv("CYCLONEDDS_URI");
}

// Programs compete for ports only where the interface has no multicast. Each network below takes
// one place of a domain.
TEST(ParticipantTest, TellsThatADomainIsFull) {
  const int domain = test::NewDomain();
  std::vector<Entity> others;
  for (int i = 0; i < 9; ++i) others.push_back(JoinOverTheNetwork(domain, test::NewDomain()));
  const std::string complaint = Complaint("lo", domain);
  if (FindInterface("lo").multicast) {
    EXPECT_EQ(complaint, "");
  } else {
    EXPECT_THAT(complaint, HasSubstr("room for nine programs"));
  }
}

TEST(ParticipantTest, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  { const Participant participant("lo", test::NewDomain()); }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace understudy::bus
