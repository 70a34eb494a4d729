#include "tests/services/services_fixture.h"

#include <stdexcept>

#include "services/robot_services.h"
#include "tests/support/robots.h"

namespace understudy::services {

ServiceTable TableOf(std::string_view robot, std::string_view service) {
  for (ServiceTable& table : ServicesOf(test::ShippedRobot(std::string(robot)).apis)) {
    if (table.name == service) return std::move(table);
  }
  throw std::out_of_range(std::string(robot) + " has no " + std::string(service));
}

}  // namespace understudy::services
