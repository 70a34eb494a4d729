// The interface between the tick and the services of a robot.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "authority/motor_owner.h"

namespace understudy::services {

// Counts over all services since the start.
struct ServiceCounts {
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;  // answered with a code other than 0
  std::uint64_t lost_replies = 0;
};

// A call that was carried out, with the vendor's code that answers it.
struct Call {
  std::string_view service;  // as in rt/api/<service>/request; lives as long as the port
  std::int64_t api_id = 0;
  std::int32_t code = 0;  // 0: done or started
};

// Polled by the tick; no function blocks or throws. ServiceHost implements it over DDS, a fake does
// for tests.
class ServicePort {
 public:
  using WallTime = std::chrono::nanoseconds;

  virtual ~ServicePort() = default;

  // Carries out the waiting calls on `owner` and sends the replies that are due. `now` is wall time
  // and must not go back. Returns the calls carried out, without those of leases; valid until the
  // next call of the port.
  virtual std::span<const Call> Poll(authority::MotorOwner* owner, WallTime now) noexcept = 0;

  // Carries out a call from this program, such as a script's, with the parameter's JSON and no
  // lease. Returns its code, or nullopt if the robot has no such service or it is not served.
  virtual std::optional<std::int32_t> Answer(std::string_view service, std::int64_t api_id,
                                             std::string_view parameter,
                                             authority::MotorOwner* owner,
                                             WallTime now) noexcept = 0;

  // Publishes what the robot's programs tell by themselves at the simulated time t [s], which must
  // not go back.
  virtual void Tell(const authority::MotorOwner& owner, double t) noexcept = 0;

  virtual ServiceCounts counts() const = 0;
};

}  // namespace understudy::services
