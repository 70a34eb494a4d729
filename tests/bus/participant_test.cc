#include "bus/participant.h"

#include <cstdlib>
#include <string>
#include <vector>

#include <gmock/gmock.h>

#include "base/errors.h"
#include "tests/bus/stranger.h"

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
  const Participant participant("lo", 101);
  EXPECT_EQ(participant.interface(), "lo");
  EXPECT_EQ(participant.domain(), 101);
  EXPECT_EQ(participant.multicast(), FindInterface("lo").multicast);
  EXPECT_NE(participant.key(), ParticipantKey{});
}

TEST(ParticipantTest, RefusesAnAbsentInterface) {
  EXPECT_THAT(Complaint("nope0", 102), HasSubstr("no network interface 'nope0'"));
}

TEST(ParticipantTest, RefusesADomainOutOfRange) {
  EXPECT_THAT(Complaint("lo", -1), HasSubstr("out of range: 0..232"));
  EXPECT_THAT(Complaint("lo", kLastDomain + 1), HasSubstr("out of range: 0..232"));
}

TEST(ParticipantTest, JoinsTheLastDomain) { EXPECT_EQ(Complaint("lo", kLastDomain), ""); }

TEST(ParticipantTest, RefusesADomainThatThisProcessHas) {
  const Participant first("lo", 103);
  EXPECT_THAT(Complaint("lo", 103), HasSubstr("in DDS domain 103 already"));
}

TEST(ParticipantTest, LeavesItsDomainForTheNext) {
  { const Participant first("lo", 104); }
  EXPECT_EQ(Complaint("lo", 104), "");
}

TEST(ParticipantTest, DoesNotReadCycloneddsUri) {
  ASSERT_EQ(setenv("CYCLONEDDS_URI", "<CycloneDDS><Domain><Nonsense/></Domain></CycloneDDS>", 1),
            0);
  EXPECT_EQ(Complaint("lo", 105), "");
  unsetenv("CYCLONEDDS_URI");
}

// Programs compete for ports only where the interface has no multicast. Each network below takes
// one place of domain 107.
TEST(ParticipantTest, TellsThatADomainIsFull) {
  std::vector<Entity> others;
  for (int alias = 170; alias < 179; ++alias) others.push_back(JoinOverTheNetwork(107, alias));
  const std::string complaint = Complaint("lo", 107);
  if (FindInterface("lo").multicast) {
    EXPECT_EQ(complaint, "");
  } else {
    EXPECT_THAT(complaint, HasSubstr("room for nine programs"));
  }
}

TEST(ParticipantTest, PrintsNothing) {
  ::testing::internal::CaptureStderr();
  { const Participant participant("lo", 106); }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

}  // namespace
}  // namespace understudy::bus
