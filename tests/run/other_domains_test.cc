#include "run/other_domains.h"

#include <gmock/gmock.h>

#include "bus/participant.h"

namespace understudy::run {
namespace {

TEST(OtherDomainsTest, AreToldByThePortsOfDiscovery) {
  EXPECT_THAT(
      DomainsIn("   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt\n"
                "  123: 00000000:1CE8 00000000:0000 07 00000000:00000000 00:00000000 00000000\n"
                "  124: 0100007F:1DEC 00000000:0000 07 00000000:00000000 00:00000000 00000000\n"
                "  125: 0100007F:0035 00000000:0000 07 00000000:00000000 00:00000000 00000000\n"
                "  126: 0100007F:9C40 00000000:0000 07 00000000:00000000 00:00000000 00000000\n"),
      testing::ElementsAre(0, 1));
}

TEST(OtherDomainsTest, AreSeenInThisNetwork) {
  const bus::Participant here("lo", 97);
  EXPECT_THAT(DomainsHere(), testing::Contains(97));
}

}  // namespace
}  // namespace understudy::run
