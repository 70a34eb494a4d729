#include "doctor/checks.h"

#include <algorithm>
#include <cmath>

namespace understudy::doctor {

std::string_view Word(CheckVerdict verdict) {
  switch (verdict) {
    case CheckVerdict::kOk:
      return "ok";
    case CheckVerdict::kWarning:
      return "warning";
    case CheckVerdict::kWrong:
      return "wrong";
    case CheckVerdict::kNotSeen:
      break;
  }
  return "not seen";
}

std::span<const Check> Checks() {
  static const std::vector<Check> kAll = [] {
    std::vector<Check> all;
    for (const auto& group : {NetworkChecks(), DomainChecks(), PeerChecks(), MachineChecks()}) {
      all.insert(all.end(), group.begin(), group.end());
    }
    return all;
  }();
  return kAll;
}

Spread SpreadOf(std::vector<double> values) {
  if (values.empty()) return {};
  std::ranges::sort(values);
  const auto rank = [&](double share) {
    const auto nth =
        static_cast<std::size_t>(std::ceil(share * static_cast<double>(values.size())));
    return values[std::max<std::size_t>(nth, 1) - 1];
  };
  return {.count = values.size(), .p50 = rank(0.5), .p99 = rank(0.99), .worst = values.back()};
}

}  // namespace understudy::doctor
