// One request/response service of the robot, rt/api/<name>/request and /response, without the
// network.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/api_row.h"

namespace understudy::services {

// The exclusive right of one client to change things through a service.
//
// Clients use rt/api/<service>_lease. Api 101 applies with {"name": text} and is answered with
// {"id": number, "term": µs}, or with 3207 while another client holds the lease; api 102 renews the
// id in header.lease.id, or is answered with 3206. A lease expires 1 s after the last renewal (term
// and rules: the server of the vendor's Python SDK). A lease is optional: while nobody holds one
// all requests pass, and the vendor's clients apply for none by default.
class Lease {
 public:
  using Time = std::chrono::nanoseconds;
  static constexpr Time kTerm = std::chrono::seconds(1);

  // Returns the reply to a request on the lease's topic. `now` is wall time and must not go back.
  ServiceReply Answer(std::int64_t api_id, std::string_view parameter, std::int64_t lease_id,
                      Time now);

  // Returns whether a request with `lease_id` (0: none) is denied with 3205: another client holds
  // the lease, or `lease_id` has expired.
  bool Denies(std::int64_t lease_id, Time now);

 private:
  void ForgetIfOver(Time now);

  std::int64_t id_ = 0;  // 0 = no holder
  std::int64_t last_id_ = 0;
  Time renewed_{0};
};

// The longest accepted binary part of a request: one chunk of the vendor's audio example. A longer
// one is refused with the service's code for a bad parameter.
inline constexpr std::size_t kMostBinaryBytes = 96000;

// One request. Its bytes come from the network and are not checked.
struct ServiceRequest {
  std::int64_t api_id = 0;
  std::int64_t lease_id = 0;
  std::string_view parameter{};
  std::size_t parameter_bytes = 0;  // more than `parameter` has: refused
  std::size_t binary_bytes = 0;
};

// Answers requests by its table, in the tick's thread. A long action is started and goes on in
// later ticks.
class Service {
 public:
  explicit Service(ServiceTable table);

  const ServiceTable& table() const { return table_; }
  // Returns the name of an api, "" if the service does not have it. Valid as long as the service.
  std::string_view NameOf(std::int64_t api_id) const;

  // Returns false while the program that serves it, or the motion service that it needs, is off.
  bool IsServed(const authority::MotorOwner& owner) const;

  // Checks in the order of the vendor's server: api 1 returns the version; an unknown api gets
  // 3203; a lease held by another client 3205; a bad parameter the service's code. Then the row
  // takes effect; an exception in it gets 3202. The reply says why it has no effect, if it has
  // none. Sets `notice` to a line for the log on what else there is to say, "" for nothing.
  ServiceReply Answer(const ServiceRequest& request, authority::MotorOwner* owner, Lease::Time now,
                      std::string* notice);

  Lease& lease() { return lease_; }
  const Settings& settings() const { return settings_; }
  void Set(std::string_view name, nlohmann::json value);

 private:
  ServiceReply Act(const ApiRow& row, const nlohmann::json& parameter, std::size_t binary_bytes,
                   authority::MotorOwner* owner, std::string* notice);
  ServiceReply Ask(const ApiRow& row, const AskGoal& effect, const nlohmann::json& parameter,
                   authority::MotorOwner* owner);
  ServiceReply Refuse(const ApiRow& row) const;

  ServiceTable table_;
  Settings settings_;
  Lease lease_;
};

// Returns whether an api only reads; it then needs no lease.
bool OnlyReads(const ApiRow& row);

}  // namespace understudy::services
