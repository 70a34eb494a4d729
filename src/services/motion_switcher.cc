#include "services/motion_switcher.h"

#include <algorithm>
#include <array>

#include <nlohmann/json.hpp>

namespace understudy {
namespace {

using nlohmann::json;

enum Api : std::int64_t {
  kCheckMode = 1001,
  kSelectMode = 1002,
  kReleaseMode = 1003,
  kSetSilent = 1004,
  kGetSilent = 1005,
};

constexpr std::int32_t kBadParameter = 7001;
constexpr std::int32_t kUnknownName = 7004;
constexpr std::int32_t kCannotSelect = 7007;

// Names and aliases that robots of the family know (hardware_contract.md, section 3). That each
// robot knows all of them, and form "0" on wheeled robots too, is assumed.
constexpr std::array<std::string_view, 6> kNames = {"ai",   "normal",   "advanced",
                                                    "ai-w", "normal-w", "mcf"};

ServiceReply Select(const json& parameter) {
  const auto name = parameter.find("name");
  if (name == parameter.end() || !name->is_string()) return {.code = kBadParameter};
  const auto& word = name->get_ref<const std::string&>();
  const bool known = std::find(kNames.begin(), kNames.end(), word) != kNames.end();
  return {.code = known ? kCannotSelect : kUnknownName};
}

ServiceReply SetSilent(const json& parameter, RobotMode* mode) {
  const auto silent = parameter.find("silent");
  if (silent == parameter.end() || !silent->is_boolean()) return {.code = kBadParameter};
  mode->silent = silent->get<bool>();
  return {};
}

}  // namespace

std::optional<ServiceReply> MotionSwitcher::Handle(std::int64_t api_id, std::string_view parameter,
                                                   RobotMode* mode) {
  const json object = json::parse(parameter, nullptr, false);
  switch (api_id) {
    case kCheckMode:
      return ServiceReply{.data = json{{"form", "0"}, {"name", mode->motion_service}}.dump()};
    case kSelectMode:
      return Select(object);
    case kReleaseMode:
      mode->motion_service.clear();
      return ServiceReply{};
    case kSetSilent:
      return SetSilent(object, mode);
    case kGetSilent:
      return ServiceReply{.data = json{{"silent", mode->silent}}.dump()};
    default:
      return std::nullopt;
  }
}

}  // namespace understudy
