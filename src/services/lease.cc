#include "services/lease.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "services/parameter.h"

namespace understudy::services {
namespace {

constexpr std::int64_t kApply = 101;
constexpr std::int64_t kRenew = 102;

}  // namespace

ServiceReply Lease::Answer(std::int64_t api_id, std::string_view parameter, std::int64_t lease_id,
                           Time now) {
  ForgetIfOver(now);
  if (api_id == kRenew) {
    if (id_ == 0 || lease_id != id_) return {.code = kRpcLeaseNotExist};
    renewed_ = now;
    return {};
  }
  if (api_id != kApply) return {.code = kRpcApiNotImplemented};
  const Field name{.key = "name", .kind = FieldKind::kText, .optional = true};
  if (!DecodeParameter(parameter, {&name, 1})) return {.code = kRpcApiParameter};
  if (id_ != 0) return {.code = kRpcLeaseExist};
  const auto micros = std::chrono::duration_cast<std::chrono::microseconds>(now).count();
  id_ = last_id_ = std::max<std::int64_t>(micros, last_id_ + 1);
  renewed_ = now;
  const auto term = std::chrono::duration_cast<std::chrono::microseconds>(kTerm).count();
  return {.data = nlohmann::json{{"id", id_}, {"term", term}}.dump()};
}

bool Lease::Denies(std::int64_t lease_id, Time now) {
  ForgetIfOver(now);
  return lease_id != id_;
}

void Lease::ForgetIfOver(Time now) {
  if (id_ != 0 && now > renewed_ + kTerm) id_ = 0;
}

}  // namespace understudy::services
