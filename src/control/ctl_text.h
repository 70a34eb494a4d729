// What `understudy ctl` shows a person.
#ifndef UNDERSTUDY_CONTROL_CTL_TEXT_H_
#define UNDERSTUDY_CONTROL_CTL_TEXT_H_

#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "control/client.h"

namespace understudy {

// Lines of label, value and unit. `status` is what StatusJson yields; throws json::exception where
// it is not.
std::string StatusText(const nlohmann::ordered_json& status);

// Lines of name, process and socket under a heading; a sentence when there are no robots.
std::string RobotsText(const std::vector<RunningRobot>& robots);

}  // namespace understudy

#endif  // UNDERSTUDY_CONTROL_CTL_TEXT_H_
