// The keys of the configuration, one row each.
#ifndef UNDERSTUDY_CONFIG_KEYS_H_
#define UNDERSTUDY_CONFIG_KEYS_H_

#include <string>
#include <vector>

#include "config/archive.h"
#include "config/config.h"

namespace understudy {

// The poses a run can start in.
const std::vector<std::string>& StartPoses();

void Describe(Archive& archive, Config& config);
void Describe(Archive& archive, RobotSpec& robot);

}  // namespace understudy

#endif  // UNDERSTUDY_CONFIG_KEYS_H_
