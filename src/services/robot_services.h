// Which services which robot has.
#ifndef UNDERSTUDY_SERVICES_ROBOT_SERVICES_H_
#define UNDERSTUDY_SERVICES_ROBOT_SERVICES_H_

#include <string>
#include <string_view>
#include <vector>

#include "services/api_row.h"

namespace understudy::services {

// Robots with services of their own, in the order of the documentation.
std::vector<std::string_view> RobotsWithServices();

// The services of the robot of that name, or of a build of it such as g1_23dof. A robot of another
// name has what every robot has: motion_switcher, robot_state, config. Ids collide between robots:
// the tables are bound here and nowhere else.
std::vector<ServiceTable> ServicesOf(std::string_view robot);

// docs/services.md: all of the above in Markdown.
std::string ServicesReference();

}  // namespace understudy::services

#endif  // UNDERSTUDY_SERVICES_ROBOT_SERVICES_H_
