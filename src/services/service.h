// A request/response service of the robot: rt/api/<name>/request and /response.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>

#include "services/api_row.h"

namespace understudy::services {

// One client's right to command a service alone.
//
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

// The longest binary part of a request that is taken: a chunk of the vendor's audio example. More
// is refused with the service's code for a bad parameter.
inline constexpr std::size_t kMostBinaryBytes = 96000;

// One request without the network. Bytes are as sent: anything may come.
struct ServiceRequest {
  std::int64_t api_id = 0;
  std::int64_t lease_id = 0;
  std::string_view parameter{};
  std::size_t parameter_bytes = 0;  // may be more than `parameter` holds: then it is refused
  std::size_t binary_bytes = 0;
};

// Answers by its table. All calls come from the tick's thread; long actions are begun, not done.
class Service {
 public:
  explicit Service(ServiceTable table);

  const ServiceTable& table() const { return table_; }

  // False while nothing would answer: the program that serves it is off, or the motion service that
  // it belongs to. Requests are then dropped, and the caller times out (3104), as seen on an H1-2.
  bool IsServed(const authority::MotorOwner& owner) const;

  // Checks in the order of the vendor's server: api 1 gives the version; an unknown api is 3203; a
  // lease that another holds 3205; a bad parameter the service's code; then the row's effect. What
  // throws inside is 3202. `notice` becomes what the log should say of it, "" for nothing.
  ServiceReply Answer(const ServiceRequest& request, authority::MotorOwner* owner, Lease::Time now,
                      std::string* notice);

  Lease& lease() { return lease_; }
  const Settings& settings() const { return settings_; }
  void Set(std::string_view name, nlohmann::json value);

 private:
  ServiceReply Act(const ApiRow& row, const nlohmann::json& parameter, std::size_t binary_bytes,
                   authority::MotorOwner* owner, std::string* notice);
  ServiceReply Ask(const ApiRow& row, const AskGoal& effect, const nlohmann::json& parameter,
                   authority::MotorOwner* owner, std::string* notice);
  ServiceReply Refuse(const ApiRow& row, std::string* notice) const;

  ServiceTable table_;
  Settings settings_;
  Lease lease_;
};

// Whether a row only reads: leases do not concern it.
bool OnlyReads(const ApiRow& row);

}  // namespace understudy::services
