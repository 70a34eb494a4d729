// Services without a wire.
#ifndef UNDERSTUDY_TESTS_SUPPORT_FAKE_SERVICES_H_
#define UNDERSTUDY_TESTS_SUPPORT_FAKE_SERVICES_H_

#include <functional>
#include <vector>

#include "services/service_port.h"

namespace understudy::test {

// Calls wait until they are polled.
class FakeServices final : public services::ServicePort {
 public:
  using Effect = std::function<void(authority::MotorOwner* owner)>;

  void Call(Effect effect) { waiting_.push_back(std::move(effect)); }

  void Poll(authority::MotorOwner* owner, WallTime) noexcept override {
    for (const Effect& effect : waiting_) effect(owner);
    counts_.requests += waiting_.size();
    waiting_.clear();
  }
  services::ServiceCounts counts() const override { return counts_; }

 private:
  std::vector<Effect> waiting_;
  services::ServiceCounts counts_;
};

}  // namespace understudy::test

#endif  // UNDERSTUDY_TESTS_SUPPORT_FAKE_SERVICES_H_
