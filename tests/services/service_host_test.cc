// Tests what the host does with a call: whether it is carried out, answered, refused, told.
#include "services/service_host.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "services/parameter.h"
#include "tests/services/service_host_fixture.h"

namespace understudy::services {
namespace {

using std::chrono::milliseconds;

TEST_F(ServiceHostTest, EchoesTheIdentityAndCarriesTheData) {
  Listen();
  SendText(41, "x");
  Send(42, 1, "");
  Send(43, 9999, "");
  ASSERT_TRUE(Answered(41) && Answered(42) && Answered(43));
  EXPECT_EQ(codes_[41], 0);
  EXPECT_EQ(apis_[41], 7);
  EXPECT_EQ(data_[41], "x");
  EXPECT_EQ(data_[42], "1.2.3.4");
  EXPECT_EQ(codes_[43], 3203);
}

TEST_F(ServiceHostTest, ActsInTheNextPollHoweverManyBroughtNothing) {
  for (std::size_t polls = 0; polls < 25; ++polls) {
    for (std::size_t i = 0; i < polls; ++i) Poll();
    SendText(static_cast<std::int64_t>(polls), "x");
    Poll();
    EXPECT_EQ(carried_out(), polls + 1);
  }
}

TEST_F(ServiceHostTest, NeitherActsNorAnswersWhileItIsOffAndCountsWhatCame) {
  Listen();
  EXPECT_EQ(host_.names(), std::vector<std::string>{"echo"});
  host_.ApplyFaults(std::vector<robot::ServiceEffects>{{.off = true}});
  SendText(1, "x");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return Refused(CallRefusal::kNotServed) == 1;
  }));
  EXPECT_EQ(carried_out(), 0U);
  EXPECT_FALSE(host_.Answer("echo", 7, R"({"a": "x"})", &robot_.owner, now_));
  host_.ApplyFaults(std::vector<robot::ServiceEffects>{{}});
  SendText(2, "y");
  ASSERT_TRUE(Answered(2));
  EXPECT_FALSE(codes_.contains(1));
}

TEST_F(ServiceHostTest, TellsWhatEachPollCarriedOut) {
  SendText(1, "");
  Send(2, 9999, "");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return calls_.size() == 2;
  }));
  EXPECT_EQ(calls_[0].service, "echo");
  EXPECT_EQ(calls_[0].name, "Echo");
  EXPECT_EQ(calls_[0].api_id, 7);
  EXPECT_EQ(calls_[0].code, 0);
  EXPECT_EQ(calls_[0].refusal, CallRefusal::kNone);
  EXPECT_EQ(calls_[1].api_id, 9999);
  EXPECT_EQ(calls_[1].code, 3203);
  EXPECT_EQ(calls_[1].refusal, CallRefusal::kUnknownApi);
  EXPECT_EQ(Refused(CallRefusal::kUnknownApi), 1U);
  EXPECT_TRUE(host_.Poll(&robot_.owner, now_).empty());
}

TEST_F(ServiceHostTest, AnswersACallFromWithinAsItDoesOneFromTheBus) {
  const auto answer = [this](std::string_view service, std::int64_t api, std::string_view text) {
    return host_.Answer(service, api, text, &robot_.owner, now_);
  };
  const std::optional<Call> echo = answer("echo", 7, R"({"a":"x"})");
  ASSERT_TRUE(echo);
  EXPECT_EQ(echo->code, 0);
  EXPECT_EQ(echo->name, "Echo");
  EXPECT_EQ(carried_out(), 1U);
  EXPECT_EQ(answer("echo", 9999, "")->code, 3203);
  const std::optional<Call> fly = answer("echo", 8, "");
  EXPECT_EQ(fly->code, 4205);
  EXPECT_EQ(fly->refusal, CallRefusal::kNotSimulated);
  EXPECT_EQ(Refused(CallRefusal::kNotSimulated), 1U);
  EXPECT_FALSE(answer("sport", 7, ""));
}

TEST_F(ServiceHostTest, AnswersAnExceptionAsInternal) {
  Listen();
  Send(1, 9, "");
  ASSERT_TRUE(Answered(1));
  EXPECT_EQ(codes_[1], 3202);
}

TEST_F(ServiceHostTest, RefusesGarbageAndTextsThatAreTooLong) {
  Listen();
  Send(1, 7, "{");
  Send(2, 7, R"({"a":")" + std::string(kMostParameterBytes, 'x') + "\"}");
  ASSERT_TRUE(Answered(1) && Answered(2));
  EXPECT_EQ(codes_[1], 3204);
  EXPECT_EQ(codes_[2], 3204);
}

TEST_F(ServiceHostTest, SaysOnceASecondWhatWentWrong) {
  Listen();
  Send(1, 9, "");
  Send(2, 9, "");
  ASSERT_TRUE(Answered(1) && Answered(2));
  EXPECT_EQ(codes_[1], 3202);
  EXPECT_EQ(said_.size(), 1U);
  now_ += std::chrono::seconds(1);
  Send(3, 9, "");
  ASSERT_TRUE(Answered(3));
  EXPECT_EQ(said_.size(), 2U);
  EXPECT_EQ(Refused(CallRefusal::kFailed), 3U);
}

TEST_F(ServiceHostTest, TellsOfARefusalAlsoWhereNoReplyIsWanted) {
  Send(1, 8, "", {.noreply = true});
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return !calls_.empty();
  }));
  EXPECT_EQ(calls_[0].refusal, CallRefusal::kNotSimulated);
  EXPECT_EQ(calls_[0].name, "Fly");
  EXPECT_EQ(Refused(CallRefusal::kNotSimulated), 1U);
}

TEST_F(ServiceHostTest, GivesItsLeaseToOneClient) {
  Listen();
  bus::Writer<Request> lease(participant_,
                             {"rt/api/echo_lease/request", &unitree_api_msg_dds__Request__desc});
  bus::Reader<Response> granted(
      participant_, {"rt/api/echo_lease/response", &unitree_api_msg_dds__Response__desc});
  Send(1, 101, R"({"name":"me"})", {}, &lease);
  std::int64_t id = 0;
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    granted.Take([&](const Response& response, bus::WriterHandle) {
      id = nlohmann::json::parse(response.data).at("id").get<std::int64_t>();
    });
    return id != 0;
  }));
  SendText(2, "");
  SendText(3, "", {.lease = id});
  ASSERT_TRUE(Answered(2) && Answered(3));
  EXPECT_EQ(codes_[2], 3205);
  EXPECT_EQ(codes_[3], 0);
}

TEST_F(ServiceHostTest, AnnouncesAChangeOfConfig) {
  wire::Outlets outlets(participant_, 0.001);
  ServiceHost host(participant_, &outlets, {TableOf("go2", "config")}, [](auto&) {});
  bus::Writer<Request> client(participant_,
                              {"rt/api/config/request", &unitree_api_msg_dds__Request__desc});
  bus::Reader<unitree_go_msg_dds__ConfigChangeStatus_> changes(
      participant_, {"rt/config_change_status", &unitree_go_msg_dds__ConfigChangeStatus__desc});
  Send(1, 1001, R"({"name":"a","content":"b"})", {}, &client);
  std::string told;
  EXPECT_TRUE(test::Eventually([&] {
    host.Poll(&robot_.owner, now_);
    changes.Take([&](const unitree_go_msg_dds__ConfigChangeStatus_& change, bus::WriterHandle) {
      told = std::string(change.name) + "=" + change.content;
    });
    return told == "a=b";
  }));
}

TEST_F(ServiceHostTest, LeavesNobodyToReadRequestsWhileItIsNotServed) {
  wire::Outlets outlets(participant_, 0.001);
  ServiceHost quiet(participant_, &outlets, {[] {
                      ServiceTable table = EchoTable(true);
                      table.name = "quiet";
                      return table;
                    }()},
                    [](auto&) {});
  bus::Writer<Request> client(participant_,
                              {"rt/api/quiet/request", &unitree_api_msg_dds__Request__desc});
  robot_.owner.Release();
  ASSERT_TRUE(test::Eventually([&] { return client.matched_readers() > 0; }));
  Send(1, 1, "", {}, &client);
  ASSERT_TRUE(test::Eventually([&] {
    quiet.Poll(&robot_.owner, now_);
    return quiet.counts().requests == 1;
  }));
  EXPECT_EQ(quiet.counts().refused[static_cast<std::size_t>(CallRefusal::kNotServed)], 1U);
  now_ += milliseconds(301);
  const auto readers_are = [&](int readers) {
    return test::Eventually([&] {
      quiet.Poll(&robot_.owner, now_);
      return client.matched_readers() == readers;
    });
  };
  EXPECT_TRUE(readers_are(0));
  EXPECT_EQ(quiet.counts().lost_replies, 0U);
  robot_.owner.Select("ai");
  ASSERT_TRUE(readers_are(1));
  quiet.ApplyFaults(std::vector<robot::ServiceEffects>{{.absent = true}});
  EXPECT_TRUE(readers_are(0)) << "its program does not run yet";
  quiet.ApplyFaults(std::vector<robot::ServiceEffects>{{.off = true}});
  EXPECT_TRUE(readers_are(1)) << "it hangs";
}

// The link of a topic on which a service publishes can be as faulty as that of a state.
TEST_F(ServiceHostTest, AnswersOverAFaultyLink) {
  ASSERT_EQ(host_.topics(),
            (std::vector<std::string>{"rt/api/echo/response", "rt/api/echo_lease/response",
                                      "rt/servicestate"}));
  Listen();
  std::vector<robot::LinkEffects> links(outlets_.size());
  links[0].drops = true;
  outlets_.BeginTick(0, links);
  SendText(1, "lost");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 1;
  }));
  links[0] = {.doubles = true, .delay = 0.5};
  SendText(2, "late");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return carried_out() == 2;
  }));
  outlets_.BeginTick(0.4, links);
  Collect();
  EXPECT_TRUE(codes_.empty());
  outlets_.BeginTick(0.5, {});
  EXPECT_TRUE(test::Eventually([&] {
    Collect();
    return order_.size() == 2;
  }));
  EXPECT_EQ(order_, (std::vector<std::int64_t>{2, 2}));
  EXPECT_EQ(host_.counts().lost_replies, 0U) << "the service has sent them";
}

}  // namespace
}  // namespace understudy::services
