// The interface between the tick and the services of a robot.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motor_owner.h"
#include "robot/fault.h"
#include "services/call_refusal.h"

namespace understudy::services {

// Counts over all services since the start.
struct ServiceCounts {
  std::uint64_t requests = 0;
  CallRefusalCounts refused{};
  std::uint64_t lost_replies = 0;
};

// A call and what came of it.
struct Call {
  std::string_view service;  // as in rt/api/<service>/request; lives as long as the port
  std::int64_t api_id = 0;
  // The vendor's, that answers it: 0 done or started, or ignored; kNoCode: it was dropped.
  std::int32_t code = 0;
  CallRefusal refusal = CallRefusal::kNone;
  std::string_view name{};  // of the api, "" if the service does not have it; lives as `service`
  std::uint64_t times = 1;  // that many such calls

  static constexpr std::int32_t kNoCode = -1;
};

// Polled by the tick; no function blocks or throws. ServiceHost implements it over DDS, a fake does
// for tests.
class ServicePort {
 public:
  using WallTime = std::chrono::nanoseconds;

  virtual ~ServicePort() = default;

  // Carries out waiting calls on `owner` and sends the replies that are due. `now` is wall time and
  // must not go back. Returns the calls carried out or dropped, without those of leases; valid
  // until the next call of the port.
  virtual std::span<const Call> Poll(authority::MotorOwner* owner, WallTime now) noexcept = 0;

  // Carries out a call from this program, such as a script's, with the parameter's JSON and no
  // lease. Returns what came of it, or nullopt if the robot has no such service or it is not
  // served.
  virtual std::optional<Call> Answer(std::string_view service, std::int64_t api_id,
                                     std::string_view parameter, authority::MotorOwner* owner,
                                     WallTime now) noexcept = 0;

  // Counts a writer of a service's requests from which nothing arrives.
  virtual void CountUnmatched() = 0;

  // Publishes what the robot's programs tell by themselves at the simulated time t [s], which must
  // not go back.
  virtual void Tell(const authority::MotorOwner& owner, double t) noexcept = 0;

  // Returns the names of the services.
  virtual std::vector<std::string> names() const = 0;
  // Returns the topics on which the robot's services and programs publish, as in
  // wire::LinkFaults::publications.
  virtual std::vector<std::string> topics() const = 0;
  // What is wrong with them from now on, in the order of names(). Allocates nothing.
  virtual void ApplyFaults(std::span<const robot::ServiceEffects> faults) noexcept = 0;

  virtual ServiceCounts counts() const = 0;
};

}  // namespace understudy::services
