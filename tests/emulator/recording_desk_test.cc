#include "emulator/recording_desk.h"

#include <chrono>
#include <future>

#include "emulator/request.h"
#include "gmock/gmock.h"
#include "gtest/gtest.h"

namespace understudy::emulator {
namespace {

using ::testing::HasSubstr;

class RecordingDeskTest : public ::testing::Test {
 protected:
  RecordingDesk dut_;
};

TEST_F(RecordingDeskTest, RefusesWhileNobodyRecords) {
  EXPECT_THAT(dut_.Start("a.mcap", false).why(), HasSubstr("by itself"));
  EXPECT_THAT(dut_.Stop().why(), HasSubstr("by itself"));
  EXPECT_EQ(dut_.order(), nullptr);
}

TEST_F(RecordingDeskTest, PassesTheFileOn) {
  dut_.Open(false);
  ASSERT_TRUE(dut_.Start("a.mcap", true));
  ASSERT_NE(dut_.order(), nullptr);
  EXPECT_TRUE(dut_.order()->starts);
  EXPECT_TRUE(dut_.order()->overwrite);
  EXPECT_STREQ(dut_.order()->file.data(), "a.mcap");
}

TEST_F(RecordingDeskTest, TakesOneOrderAtATime) {
  dut_.Open(true);
  ASSERT_TRUE(dut_.Stop());
  EXPECT_FALSE(dut_.order()->starts);
  EXPECT_THAT(dut_.Stop().why(), HasSubstr("being started or ended"));
  EXPECT_THAT(dut_.Start("", false).why(), HasSubstr("being started or ended"));
  dut_.Done(false, {});
  EXPECT_EQ(dut_.order(), nullptr);
  EXPECT_TRUE(dut_.Start("", false));
}

TEST_F(RecordingDeskTest, KnowsWhetherARecordingIsOn) {
  dut_.Open(false);
  EXPECT_THAT(dut_.Stop().why(), HasSubstr("record.start"));
  ASSERT_TRUE(dut_.Start("", false));
  dut_.Done(true, {});
  EXPECT_THAT(dut_.Start("", false).why(), HasSubstr("record.stop"));
  ASSERT_TRUE(dut_.Stop());
  dut_.Done(false, {});
  EXPECT_FALSE(dut_.Stop());
}

TEST_F(RecordingDeskTest, AnswersTheRequestOnceAStatusCouldShowThatTheOrderIsDone) {
  Inbox inbox;
  dut_.Open(false);
  auto asked = inbox.Put(*ReadRequest("record.start", {{"file", "a.mcap"}}));
  inbox.Drain([this](Request* request, Reply* reply) -> std::optional<Answer> {
    EXPECT_TRUE(request->waits());
    EXPECT_TRUE(dut_.Start(request->file(), request->on("overwrite")));
    dut_.Keep(std::move(*reply));
    return std::nullopt;
  });
  EXPECT_EQ(asked->answer.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  dut_.GiveAnswer();
  EXPECT_EQ(asked->answer.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  dut_.Done(false, Error{"no room"});
  EXPECT_EQ(asked->answer.wait_for(std::chrono::seconds(0)), std::future_status::timeout);
  dut_.GiveAnswer();
  ASSERT_EQ(asked->answer.wait_for(std::chrono::seconds(0)), std::future_status::ready);
  EXPECT_EQ(asked->answer.get().why(), "no room");
}

}  // namespace
}  // namespace understudy::emulator
