// The services of a robot as the tick sees them: calls come in, replies go out.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "authority/motor_owner.h"

namespace understudy::services {

// Of all services, since start.
struct ServiceCounts {
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;  // answered by a code other than 0
  std::uint64_t lost_replies = 0;
};

// A call that was carried out, and the vendor's code that answers it.
struct Call {
  std::string_view service;  // as in rt/api/<service>/request; lives as long as the port
  std::int64_t api_id = 0;
  std::int32_t code = 0;  // 0: done, or begun
};

// A real one over DDS, and a fake one for tests. Polled by the tick; nothing here blocks or throws.
class ServicePort {
 public:
  using WallTime = std::chrono::nanoseconds;

  virtual ~ServicePort() = default;

  // Carries out the calls that wait on `owner` and sends the replies that can go. `now` only has to
  // grow. Returns what was carried out, leases left aside; valid until the next call of the port.
  virtual std::span<const Call> Poll(authority::MotorOwner* owner, WallTime now) noexcept = 0;

  // One call from within the program, such as a script's, with the parameter's JSON and no lease.
  // Its code; nullopt where nothing answers: the robot has no such service, or it is not served.
  virtual std::optional<std::int32_t> Answer(std::string_view service, std::int64_t api_id,
                                             std::string_view parameter,
                                             authority::MotorOwner* owner,
                                             WallTime now) noexcept = 0;

  virtual ServiceCounts counts() const = 0;
};

}  // namespace understudy::services
