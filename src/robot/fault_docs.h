// What the documentation says of faults.
#pragma once

#include <string>

namespace understudy::robot {

// Returns docs/reference/faults.md.
std::string FaultsReference();

}  // namespace understudy::robot
