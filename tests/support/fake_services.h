// Services without a bus.
#pragma once

#include <functional>
#include <vector>

#include "services/service_port.h"

namespace understudy::test {

// Calls wait until they are polled, and are told of as calls of an api 1 of "fake".
class FakeServices final : public services::ServicePort {
 public:
  using Effect = std::function<void(authority::MotorOwner* owner)>;

  // Polling it allocates nothing.
  void Call(Effect effect) {
    waiting_.push_back(std::move(effect));
    calls_.reserve(waiting_.size());
  }

  std::span<const services::Call> Poll(authority::MotorOwner* owner,
                                       WallTime now) noexcept override {
    polled_at_ = now;
    calls_.clear();
    for (const Effect& effect : waiting_) {
      effect(owner);
      calls_.push_back({.service = "fake", .api_id = 1, .code = 0});
    }
    counts_.requests += waiting_.size();
    waiting_.clear();
    for (const services::Call& call : brought_) calls_.push_back(call);
    brought_.clear();
    return calls_;
  }
  WallTime polled_at() const { return polled_at_; }
  // "release" of no parameter is all that there is.
  std::optional<services::Call> Answer(std::string_view service, std::int64_t api_id,
                                       std::string_view, authority::MotorOwner* owner,
                                       WallTime) noexcept override {
    if (service != "release") return std::nullopt;
    owner->Release();
    return services::Call{.service = "release", .api_id = api_id};
  }
  void Tell(const authority::MotorOwner&, double) noexcept override {}
  void CountUnmatched() override {
    ++counts_.refused[static_cast<std::size_t>(services::CallRefusal::kUnmatched)];
  }
  std::vector<std::string> names() const override { return {"fake"}; }
  std::vector<std::string> topics() const override { return {"rt/api/fake/response"}; }
  void ApplyFaults(std::span<const robot::ServiceEffects> faults) noexcept override {
    suffers_ = faults[0];
  }
  const robot::ServiceEffects& suffers() const { return suffers_; }
  // The next poll returns it.
  void Bring(const services::Call& call) { brought_.push_back(call); }
  services::ServiceCounts counts() const override { return counts_; }

 private:
  WallTime polled_at_{};
  std::vector<Effect> waiting_;
  std::vector<services::Call> calls_, brought_;
  services::ServiceCounts counts_;
  robot::ServiceEffects suffers_;
};

}  // namespace understudy::test
