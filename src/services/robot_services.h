// Finds the services of a robot and documents them.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "services/api_row.h"

namespace understudy::services {

// Returns the table of that name. Throws std::out_of_range if it is not among kApiNames.
ServiceTable TableNamed(std::string_view name);

// Returns the tables of robot.apis, in its order. Throws as above, and ConfigError for two variants
// of one service.
std::vector<ServiceTable> ServicesOf(const std::vector<std::string>& apis);

// Returns docs/reference/services.md: every table in Markdown.
std::string ServicesReference();

}  // namespace understudy::services
