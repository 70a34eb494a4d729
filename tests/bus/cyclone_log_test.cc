#include "bus/cyclone_log.h"

#include <chrono>
#include <thread>

#include <gmock/gmock.h>

#include "bus/reader.h"
#include "tests/bus/garbage_writer.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::bus {
namespace {

using ::testing::AllOf;
using ::testing::ElementsAre;
using ::testing::Field;
using ::testing::Ge;
using ::testing::HasSubstr;

constexpr Topic<Hello> kTopic{"rt/hello", &HelloWorldData_Msg_desc};

TEST(CycloneNoticeTest, IsMadeOfBytesThatAreNoMessageWhichAreCountedAndNotPrinted) {
  const int domain = test::NewDomain(), alias = test::NewDomain();
  const Participant ours("lo", domain);
  const Reader<Hello> reader(ours, kTopic);
  const Entity network = JoinOverTheNetwork(domain, alias);
  const Stranger stranger(alias);
  const GarbageWriter garbage(stranger, kTopic.name, HelloWorldData_Msg_desc);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  TakeCycloneNotices();
  testing::internal::CaptureStderr();
  const auto garbage_came = [&] {
    garbage.Send();
    return reader.undecoded() >= 2;
  };
  EXPECT_TRUE(test::Eventually(garbage_came));
  std::this_thread::sleep_for(std::chrono::milliseconds(500));  // what was sent may be under way
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_THAT(TakeCycloneNotices(),
              ElementsAre(AllOf(Field(&CycloneNotice::line, HasSubstr("rt/hello")),
                                Field(&CycloneNotice::count, Ge(2U)))));
  EXPECT_THAT(TakeCycloneNotices(), ElementsAre());
}

// Two robots in one process, each with a participant of its own.
TEST(UndecodedSamplesTest, AreThoseOfTheReadersParticipantOnly) {
  const int domain = test::NewDomain(), other = test::NewDomain(), alias = test::NewDomain();
  const Participant ours("lo", domain), another("lo", other);
  const Reader<Hello> reader(ours, kTopic), elsewhere(another, kTopic);
  const Entity network = JoinOverTheNetwork(domain, alias);
  const Stranger stranger(alias);
  const GarbageWriter garbage(stranger, kTopic.name, HelloWorldData_Msg_desc);
  ASSERT_TRUE(test::Eventually([&] { return reader.matched_writers() == 1; }));
  EXPECT_TRUE(test::Eventually([&] {
    garbage.Send();
    return reader.undecoded() >= 2;
  }));
  EXPECT_EQ(elsewhere.undecoded(), 0U);
}

TEST(CycloneNoticeTest, SaysHowOften) {
  EXPECT_EQ((CycloneNotice{.line = "bad", .count = 1}.text()), "bad");
  EXPECT_EQ((CycloneNotice{.line = "bad", .count = 3}.text()), "bad (3 times)");
}

}  // namespace
}  // namespace understudy::bus
