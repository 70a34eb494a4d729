// One client's right to command a service alone.
#pragma once

#include <chrono>
#include <cstdint>
#include <string_view>

#include "services/api_row.h"

namespace understudy::services {

// Asked for on rt/api/<service>_lease: api 101 applies with {"name": text} and is answered
// {"id": number, "term": µs}, or 3207 while another holds it; api 102 renews the id in
// header.lease.id, or 3206. A lease that is not renewed within its term of 1 s is over (term and
// rules: the server of the vendor's Python SDK). Nobody has to hold one: without a lease all
// requests pass, and the vendor's clients ask for none by default.
class Lease {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr Time kTerm = std::chrono::seconds(1);

  // The reply to a request on the lease's topic. `now` only has to grow.
  ServiceReply Answer(std::int64_t api_id, std::string_view parameter, std::int64_t lease_id,
                      Time now);

  // Whether a request that carries `lease_id`, 0 for none, is denied (3205): because another client
  // holds the lease, or because it names one that is over.
  bool Denies(std::int64_t lease_id, Time now);

 private:
  void ForgetIfOver(Time now);

  std::int64_t id_ = 0;  // 0 = nobody's
  std::int64_t last_id_ = 0;
  Time renewed_{0};
};

}  // namespace understudy::services
