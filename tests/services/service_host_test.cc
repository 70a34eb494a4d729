// The host on a real bus, loopback, a domain of its own.
#include "services/service_host.h"

#include <map>

#include <gtest/gtest.h>

#include "bus/participant.h"
#include "tests/support/eventually.h"

namespace understudy {
namespace {

using Request = unitree_api_msg_dds__Request_;
using Response = unitree_api_msg_dds__Response_;
using std::chrono::milliseconds;

constexpr char kRequests[] = "rt/api/echo/request";
constexpr char kResponses[] = "rt/api/echo/response";

// Answers api 7 with what it was given and counts.
class Echo final : public Service {
 public:
  explicit Echo(int* handled) : handled_(handled) {}
  std::string_view name() const override { return "echo"; }
  std::string_view api_version() const override { return "1.2.3.4"; }
  std::optional<ServiceReply> Handle(std::int64_t api, std::string_view parameter,
                                     RobotMode*) override {
    ++*handled_;
    if (api != 7) return std::nullopt;
    return ServiceReply{.data = std::string(parameter)};
  }

 private:
  int* handled_;
};

class ServiceHostTest : public testing::Test {
 protected:
  static constexpr int kDomain = 141;

  static std::vector<std::unique_ptr<Service>> Services(int* handled) {
    std::vector<std::unique_ptr<Service>> services;
    services.push_back(std::make_unique<Echo>(handled));
    return services;
  }

  void Send(std::int64_t id, std::int64_t api, const std::string& parameter, bool noreply = false) {
    Request request{};
    request.header.identity.id = id;
    request.header.identity.api_id = api;
    request.header.policy.noreply = noreply;
    std::string text = parameter;
    request.parameter = text.data();
    ASSERT_TRUE(requests_.Write(request));
  }

  void Poll() { host_.Poll(&mode_, now_); }

  void Collect(Reader<Response>* reader) {
    reader->Take([this](const Response& response, WriterHandle) {
      codes_[response.header.identity.id] = response.header.status.code;
      data_[response.header.identity.id] = response.data;
      apis_[response.header.identity.id] = response.header.identity.api_id;
    });
  }

  int handled_ = 0;
  RobotMode mode_;
  ServiceHost::WallTime now_{0};
  Participant participant_{"lo", kDomain};
  ServiceHost host_{participant_, Services(&handled_)};
  Writer<Request> requests_{participant_, {kRequests, &unitree_api_msg_dds__Request__desc}};
  std::map<std::int64_t, std::int32_t> codes_;
  std::map<std::int64_t, std::string> data_;
  std::map<std::int64_t, std::int64_t> apis_;
};

TEST_F(ServiceHostTest, EchoesTheIdentityAndCarriesTheData) {
  Reader<Response> responses(participant_, {kResponses, &unitree_api_msg_dds__Response__desc});
  Send(41, 7, "{\"a\":1}");
  Send(42, 1, "");
  Send(43, 9999, "");
  ASSERT_TRUE(Eventually([&] {
    Poll();
    Collect(&responses);
    return codes_.size() == 3;
  }));
  EXPECT_EQ(codes_[41], 0);
  EXPECT_EQ(apis_[41], 7);
  EXPECT_EQ(data_[41], "{\"a\":1}");
  EXPECT_EQ(data_[42], "1.2.3.4");
  EXPECT_EQ(codes_[43], 3203);
}

TEST_F(ServiceHostTest, HoldsAReplyUntilTheClientsReaderIsThere) {
  Send(1, 7, "early");
  ASSERT_TRUE(Eventually([&] {
    Poll();
    return handled_ == 1;
  }));
  Poll();
  Reader<Response> responses(participant_, {kResponses, &unitree_api_msg_dds__Response__desc});
  ASSERT_TRUE(Eventually([&] {
    Poll();
    Collect(&responses);
    return codes_.contains(1);
  }));
  EXPECT_EQ(data_[1], "early");
  EXPECT_EQ(host_.lost_replies(), 0U);
}

TEST_F(ServiceHostTest, GivesUpAReplyThatNobodyWaitsFor) {
  Send(1, 7, "");
  ASSERT_TRUE(Eventually([&] {
    Poll();
    return handled_ == 1;
  }));
  now_ += milliseconds(301);
  Poll();
  EXPECT_EQ(host_.lost_replies(), 1U);
}

TEST_F(ServiceHostTest, CarriesOutButDoesNotAnswerANoreplyRequest) {
  Reader<Response> responses(participant_, {kResponses, &unitree_api_msg_dds__Response__desc});
  Send(1, 7, "", true);
  Send(2, 7, "");
  ASSERT_TRUE(Eventually([&] {
    Poll();
    Collect(&responses);
    return codes_.contains(2);
  }));
  EXPECT_EQ(handled_, 2);
  EXPECT_FALSE(codes_.contains(1));
}

TEST_F(ServiceHostTest, ForgetsTheOldestWhenTooManyRepliesWait) {
  for (int i = 0; i < 65; ++i) {
    Send(i, 7, "");
    ASSERT_TRUE(Eventually([&] {
      Poll();
      return handled_ == i + 1;
    }));
  }
  EXPECT_EQ(host_.lost_replies(), 1U);
}

}  // namespace
}  // namespace understudy
