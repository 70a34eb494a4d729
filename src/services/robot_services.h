// Which services which robot has.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "services/api_row.h"

namespace understudy::services {

// The table of that name; throws std::out_of_range for one that is not among kApiNames.
ServiceTable TableNamed(std::string_view name);

// The tables of robot.apis, in its order. Throws as above, and ConfigError for two variants of one
// service.
std::vector<ServiceTable> ServicesOf(const std::vector<std::string>& apis);

// docs/services.md: every table in Markdown, and which robot has which. `robots` maps the name of
// each robot to its robot.apis.
std::string ServicesReference(const std::map<std::string, std::vector<std::string>>& robots);

}  // namespace understudy::services
