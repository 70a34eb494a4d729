// Tests the host on a real bus: loopback, in a separate domain.
#include "services/service_host.h"

#include <map>
#include <stdexcept>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bus/participant.h"
#include "services/parameter.h"
#include "tests/services/services_fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::services {
namespace {

using Request = unitree_api_msg_dds__Request_;
using Response = unitree_api_msg_dds__Response_;
using std::chrono::milliseconds;

// Api 7 answers the text it was given and asks for a goal, whose value counts calls in a script; 8
// is not simulated; 9 throws; 10 is answered after the arm; all of it is "echo".
ServiceTable EchoTable(bool needs_motion) {
  const Field text{.key = "a", .kind = FieldKind::kText};
  return {
      .name = "echo",
      .title = "echo",
      .api_version = "1.2.3.4",
      .codes = {.unable = 4205},
      .needs_motion = needs_motion,
      .rows = {{.id = 7,
                .name = "Echo",
                .fields = {text},
                .effect = Special{[](const ServiceCall& call) {
                  call.owner->Ask({});
                  return ServiceReply{.data = call.parameter.at("a").get<std::string>()};
                }}},
               {.id = 8, .name = "Fly", .effect = NoController{}},
               {.id = 9, .name = "Throw", .effect = Special{[](const ServiceCall&) -> ServiceReply {
                                            throw std::runtime_error("oh");
                                          }}},
               {.id = 10, .name = "Wave", .effect = Special{[](const ServiceCall&) {
                                            return ServiceReply{
                                                .once =
                                                    [](const robot::MotionState& state) {
                                                      return state.arm_action == 0 ||
                                                             state.arm_holding;
                                                    },
                                                .patience = std::chrono::seconds(20)};
                                          }}}}};
}

struct Options {
  bool noreply = false;
  int priority = 0;
  std::int64_t lease = 0;
};

class ServiceHostTest : public testing::Test {
 protected:
  void Send(std::int64_t id, std::int64_t api, const std::string& parameter,
            const Options& options = {}, bus::Writer<Request>* writer = nullptr) {
    Request request{};
    request.header.identity.id = id;
    request.header.identity.api_id = api;
    request.header.lease.id = options.lease;
    request.header.policy.noreply = options.noreply;
    request.header.policy.priority = options.priority;
    std::string text = parameter;
    request.parameter = text.data();
    ASSERT_TRUE((writer == nullptr ? &requests_ : writer)->Write(request));
  }
  void SendText(std::int64_t id, const std::string& text, const Options& options = {}) {
    Send(id, 7, nlohmann::json{{"a", text}}.dump(), options);
  }

  void Poll() {
    for (const Call& call : host_.Poll(&robot_.owner, now_)) calls_.push_back(call);
  }
  std::uint64_t Refused(CallRefusal refusal) const {
    return host_.counts().refused[static_cast<std::size_t>(refusal)];
  }
  std::size_t carried_out() const { return robot_.book.goals.size(); }

  void Collect() {
    responses_->Take([this](const Response& response, bus::WriterHandle) {
      order_.push_back(response.header.identity.id);
      codes_[response.header.identity.id] = response.header.status.code;
      data_[response.header.identity.id] = response.data;
      apis_[response.header.identity.id] = response.header.identity.api_id;
    });
  }
  void Listen() {
    responses_.emplace(participant_, bus::Topic<Response>{"rt/api/echo/response",
                                                          &unitree_api_msg_dds__Response__desc});
  }
  ::testing::AssertionResult Answered(std::int64_t id) {
    if (test::Eventually([&] {
          Poll();
          Collect();
          return codes_.contains(id);
        })) {
      return ::testing::AssertionSuccess();
    }
    return ::testing::AssertionFailure() << id << " was not answered";
  }

  ServedRobot robot_;
  ServiceHost::WallTime now_{0};
  std::vector<std::string> said_;
  std::vector<Call> calls_;
  bus::Participant participant_{"lo", test::NewDomain()};
  ServiceHost host_{
      participant_, {EchoTable(false)}, [this](auto& text) { said_.push_back(text); }};
  bus::Writer<Request> requests_{participant_,
                                 {"rt/api/echo/request", &unitree_api_msg_dds__Request__desc}};
  std::optional<bus::Reader<Response>> responses_;
  std::vector<std::int64_t> order_;
  std::map<std::int64_t, std::int32_t> codes_;
  std::map<std::int64_t, std::string> data_;
  std::map<std::int64_t, std::int64_t> apis_;
};

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
  host_.Suffer(std::vector<robot::ServiceEffects>{{.off = true}});
  SendText(1, "x");
  ASSERT_TRUE(test::Eventually([&] {
    Poll();
    return Refused(CallRefusal::kNotServed) == 1;
  }));
  EXPECT_EQ(carried_out(), 0U);
  EXPECT_FALSE(host_.Answer("echo", 7, R"({"a": "x"})", &robot_.owner, now_));
  host_.Suffer(std::vector<robot::ServiceEffects>{{}});
  SendText(2, "y");
  ASSERT_TRUE(Answered(2));
  EXPECT_FALSE(codes_.contains(1));
}

TEST_F(ServiceHostTest, ActsAtOnceAndAnswersLaterWhileItIsSlow) {
  Listen();
  host_.Suffer(std::vector<robot::ServiceEffects>{{.delay = 2}});
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
  ServiceHost host(participant_,
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
  ServiceHost host(participant_, {TableOf("go2", "config")}, [](auto&) {});
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

TEST_F(ServiceHostTest, DropsWhatComesForAServiceThatIsNotServed) {
  ServiceHost quiet(participant_, {[] {
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
  quiet.Poll(&robot_.owner, now_);
  EXPECT_EQ(quiet.counts().lost_replies, 0U);
}

}  // namespace
}  // namespace understudy::services
