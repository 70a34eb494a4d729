// The services of a robot as the tick sees them: calls come in, replies go out.
#ifndef UNDERSTUDY_SERVICES_SERVICE_PORT_H_
#define UNDERSTUDY_SERVICES_SERVICE_PORT_H_

#include <chrono>
#include <cstdint>

#include "authority/motor_owner.h"

namespace understudy::services {

// Of all services, since start.
struct ServiceCounts {
  std::uint64_t requests = 0;
  std::uint64_t refused = 0;  // answered by a code other than 0
  std::uint64_t lost_replies = 0;
};

// A real one over DDS, and a fake one for tests. Polled by the tick; nothing here blocks or throws.
class ServicePort {
 public:
  using WallTime = std::chrono::nanoseconds;

  virtual ~ServicePort() = default;

  // Carries out the calls that wait on `owner` and sends the replies that can go. `now` only has to
  // grow.
  virtual void Poll(authority::MotorOwner* owner, WallTime now) noexcept = 0;

  virtual ServiceCounts counts() const = 0;
};

}  // namespace understudy::services

#endif  // UNDERSTUDY_SERVICES_SERVICE_PORT_H_
