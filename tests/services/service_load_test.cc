// Tests how much the host serves in a poll, in which order, and what it has no room for.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/parameter.h"
#include "tests/services/service_host_fixture.h"

namespace understudy::services {
namespace {

TEST_F(ServiceHostTest, ServesAtMostEightOfAServiceInAPoll) {
  for (int i = 0; i < 30; ++i) SendText(i, "");
  std::size_t before = 0, most = 0;
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    most = std::max(most, carried_out() - before);
    before = carried_out();
    return before == 30;
  }));
  EXPECT_LE(most, 8U);
}

// A parameter that takes as much work as a poll does, or more.
TEST_F(ServiceHostTest, ServesOneOfTheLongestRequestsInAPollAndTheRestLater) {
  const std::string text(kMostParameterBytes - 10, 'x');
  for (int i = 0; i < 6; ++i) SendText(i, text, {.noreply = true});
  std::size_t before = 0, most = 0, polls = 0;
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    most = std::max(most, carried_out() - before);
    polls += carried_out() > before ? 1 : 0;
    before = carried_out();
    return before == 6;
  }));
  EXPECT_LE(most, 2U);
  EXPECT_GE(polls, 3U);
}

TEST_F(ServiceHostTest, DoesNotKeepAServiceWaitingForAnothersFlood) {
  ServiceTable other = EchoTable(false);
  other.name = "other";
  wire::Outlets outlets(participant_, 0.001);
  ServiceHost host(participant_, &outlets,
                   {[] {
                      ServiceTable first = EchoTable(false);
                      first.name = "first";
                      return first;
                    }(),
                    std::move(other)},
                   [](auto&) {});
  bus::Writer<Request> flood(participant_,
                             {"rt/api/first/request", &unitree_api_msg_dds__Request__desc});
  bus::Writer<Request> client(participant_,
                              {"rt/api/other/request", &unitree_api_msg_dds__Request__desc});
  const std::string text = nlohmann::json{{"a", std::string(16000, 'x')}}.dump();
  for (int i = 0; i < 100; ++i) Send(i, 7, text, {.noreply = true}, &flood);
  Send(1, 7, text, {.noreply = true}, &client);
  int polls = 0;
  bool served = false;
  while (!served && polls < 100) {
    ++polls;
    for (const Call& call : host.Poll(&robot_.owner, now_)) served |= call.service == "other";
  }
  EXPECT_TRUE(served);
  EXPECT_LE(polls, 3);
}

TEST_F(ServiceHostTest, CountsAndTellsWhatItHasNoRoomFor) {
  for (int i = 0; i < 400; ++i) {
    SendText(i, "", {.noreply = true});
    if (i == 200) Poll();
  }
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() + Refused(CallRefusal::kTooMany) == 400;
  }));
  EXPECT_GT(Refused(CallRefusal::kTooMany), 0U);
  EXPECT_EQ(host_.counts().requests, 400U);
  std::uint64_t told = 0;
  for (const Call& call : calls_) {
    if (call.refusal != CallRefusal::kTooMany) continue;
    EXPECT_EQ(call.code, Call::kNoCode);
    told += call.times;
  }
  EXPECT_EQ(told, Refused(CallRefusal::kTooMany));
}

TEST_F(ServiceHostTest, ServesPriorityFirst) {
  Listen();
  for (int i = 0; i < 3; ++i) SendText(i, "");
  SendText(100, "", {.priority = 1});
  ASSERT_TRUE(Answered(0) && Answered(1) && Answered(2) && Answered(100));
  EXPECT_EQ(order_.front(), 100);
}

}  // namespace
}  // namespace understudy::services
