#include "bus/participant.h"

#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/bus/stranger.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::HasSubstr;

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

TEST(ParticipantTest, RefusesADomainThatThisProcessHas) {
  const int domain = test::NewDomain();
  const Participant first("lo", domain);
  EXPECT_THAT(Complaint("lo", domain),
              HasSubstr("in DDS domain " + std::to_string(domain) + " already"));
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
