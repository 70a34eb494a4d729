// Tests when the host replies: at once, later, when a reader or an end has come, or not at all.
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "tests/services/service_host_fixture.h"

namespace understudy::services {
namespace {

using std::chrono::milliseconds;

TEST_F(ServiceHostTest, ActsAtOnceAndAnswersLaterWhileItIsSlow) {
  Listen();
  host_.ApplyFaults(std::vector<robot::ServiceEffects>{{.delay = 2}});
  SendText(1, "x");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 1;
  }));
  now_ += std::chrono::milliseconds(1999);
  Poll();
  Collect();
  EXPECT_FALSE(codes_.contains(1));
  now_ += std::chrono::milliseconds(2);
  EXPECT_TRUE(Answered(1));
}

TEST_F(ServiceHostTest, HoldsAReplyUntilTheClientsReaderIsThere) {
  SendText(1, "early");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 1;
  }));
  Poll();
  Listen();
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(data_[1], "early");
  EXPECT_EQ(host_.counts().lost_replies, 0U);
}

TEST_F(ServiceHostTest, GivesUpAReplyThatNobodyWaitsFor) {
  SendText(1, "");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 1;
  }));
  now_ += milliseconds(301);
  Poll();
  EXPECT_EQ(host_.counts().lost_replies, 1U);
}

TEST_F(ServiceHostTest, GivesUpTheRepliesOfAClientThatEnded) {
  {
    bus::Writer<Request> client(participant_,
                                {"rt/api/echo/request", &unitree_api_msg_dds__Request__desc});
    Send(1, 7, R"({"a":""})", {}, &client);
  }
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 1;
  }));
  Listen();
  SendText(2, "next");
  EXPECT_TRUE(Answered(2));
}

TEST_F(ServiceHostTest, CarriesOutButDoesNotAnswerANoreplyRequest) {
  Listen();
  SendText(1, "", {.noreply = true});
  SendText(2, "");
  ASSERT_TRUE(Answered(2));
  EXPECT_EQ(carried_out(), 2U);
  EXPECT_FALSE(codes_.contains(1));
}

TEST_F(ServiceHostTest, ForgetsTheOldestWhenTooManyRepliesWait) {
  for (std::size_t i = 0; i < 65; ++i) {
    SendText(static_cast<std::int64_t>(i), "");
    ASSERT_TRUE(test::Eventually([&] {
      Poll();
      return carried_out() == i + 1;
    }));
  }
  EXPECT_EQ(host_.counts().lost_replies, 1U);
}

TEST_F(ServiceHostTest, LosesNoReplyOfABurst) {
  Listen();
  constexpr int kBurst = 250;  // within what the reader holds
  for (int i = 0; i < kBurst; ++i) SendText(i, "");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    Collect();
    return codes_.size() == kBurst;
  }));
  EXPECT_EQ(host_.counts().lost_replies, 0U);
}

TEST_F(ServiceHostTest, AnswersAnArmActionWhenItHasEnded) {
  Listen();
  robot_.Be({.arm_action = 27});
  Send(1, 10, "");
  Send(2, 8, "");
  ASSERT_TRUE(Answered(2));
  EXPECT_FALSE(codes_.contains(1));
  robot_.Be({.arm_action = 0});
  EXPECT_TRUE(Answered(1));
}

}  // namespace
}  // namespace understudy::services
