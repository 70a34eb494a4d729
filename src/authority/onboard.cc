#include "authority/onboard.h"

#include <algorithm>

#include "robot/firmware.h"

namespace understudy::authority {
namespace {

// Names: config/robots/g1.yaml, as a robot listed them. That each drives the hand of its letter is
// *assumed*. No list of a robot with other hands is known.
struct HandProgramRow {
  std::string_view law, hand, program;
};
constexpr HandProgramRow kHandPrograms[] = {{"dex3", "left", "dex3_service_l"},
                                            {"dex3", "right", "dex3_service_r"}};

}  // namespace

std::vector<std::string> MotionServices(const robot::RobotSpec& spec) {
  std::vector<std::string> aliases;
  for (const robot::ServiceSpec& service : spec.services) {
    if (!service.alias.empty() && robot::HasService(spec.firmware, service)) {
      aliases.push_back(service.alias);
    }
  }
  return aliases;
}

const robot::ServiceSpec& MotionService(const robot::RobotSpec& spec, std::string_view alias) {
  return *std::ranges::find_if(spec.services, [&](const robot::ServiceSpec& service) {
    return service.alias == alias && robot::HasService(spec.firmware, service);
  });
}

std::string StartService(const robot::RobotSpec& spec, const MotionConfig& config) {
  if (config.service == kNoService) return {};
  if (!config.service.empty()) return config.service;
  const std::vector<std::string> aliases = MotionServices(spec);
  return aliases.empty() ? std::string() : aliases.front();
}

std::vector<OnboardService> OnboardServices(const robot::RobotSpec& spec, std::string_view on) {
  std::vector<OnboardService> services;
  for (const robot::ServiceSpec& service : spec.services) {
    if (!robot::HasService(spec.firmware, service)) continue;
    services.push_back({.name = service.name,
                        .alias = service.alias,
                        .on = service.alias.empty() ? service.on : service.alias == on,
                        .is_protected = service.protect,
                        .version = service.version});
  }
  return services;
}

std::string_view HandProgram(const robot::HandSpec& hand) {
  for (const HandProgramRow& row : kHandPrograms) {
    if (row.law == hand.law && row.hand == hand.name) return row.program;
  }
  return {};
}

}  // namespace understudy::authority
