// Serves a table of four apis on a real bus: loopback, in a separate domain.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "bus/participant.h"
#include "services/service_host.h"
#include "tests/services/services_fixture.h"
#include "tests/support/eventually.h"
#include "tests/support/new_domain.h"

namespace understudy::services {

// Api 7 answers the text it was given and asks for a goal, whose value counts calls in a script; 8
// is not simulated; 9 throws; 10 is answered after the arm; 11 gives a picture; all of it is
// "echo".
ServiceTable EchoTable(bool needs_motion);

struct CallOptions {
  bool noreply = false;
  int priority = 0;
  std::int64_t lease = 0;
};

class ServiceHostTest : public testing::Test {
 protected:
  using Request = unitree_api_msg_dds__Request_;
  using Response = unitree_api_msg_dds__Response_;

  void Send(std::int64_t id, std::int64_t api, const std::string& parameter,
            const CallOptions& options = {}, bus::Writer<Request>* writer = nullptr) {
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
  void SendText(std::int64_t id, const std::string& text, const CallOptions& options = {}) {
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
      const dds_sequence_uint8& binary = response.binary;
      binaries_[response.header.identity.id].assign(binary._buffer,
                                                    binary._buffer + binary._length);
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
  wire::Outlets outlets_{participant_, 0.001};
  ServiceHost host_{
      participant_, &outlets_, {EchoTable(false)}, [this](auto& text) { said_.push_back(text); }};
  bus::Writer<Request> requests_{participant_,
                                 {"rt/api/echo/request", &unitree_api_msg_dds__Request__desc}};
  std::optional<bus::Reader<Response>> responses_;
  std::vector<std::int64_t> order_;
  std::map<std::int64_t, std::int32_t> codes_;
  std::map<std::int64_t, std::string> data_;
  std::map<std::int64_t, std::vector<std::uint8_t>> binaries_;
  std::map<std::int64_t, std::int64_t> apis_;
};

}  // namespace understudy::services
