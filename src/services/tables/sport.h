// Declares what the sport services of quadrupeds have alike. Private to services/.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "services/api_row.h"

namespace understudy::services::sport {

inline constexpr std::int32_t kActionTimeout = 4201;
inline constexpr std::int32_t kNotPlayed = 4205;

// Returns what became of a goal, in the codes of all of them.
ServiceReply CodeOf(authority::MotionVerdict verdict);

// Returns the path of the array of points under `key`.
authority::goal::FollowPath PathOf(const nlohmann::json& parameter, std::string_view key);

// Follows the parameter, which is an array of points.
ServiceReply FollowB2Path(const ServiceCall& call);

// Returns a text as it is, any other value as JSON.
std::string AsText(const nlohmann::json& value);

// Returns what all of them have alike, the first six apis among it, and then the `further` ones.
ServiceTable Sport(std::string_view title, std::string_view source, std::vector<ApiRow> further,
                   std::vector<std::pair<std::string_view, std::string_view>> settings,
                   std::string_view note);

ApiRow SpeedLevel(Field level, std::string_view source);
ApiRow SwitchGait(std::string_view source);

}  // namespace understudy::services::sport
