#include "wire/open_port.h"

#include "wire/go_port.h"
#include "wire/hg_port.h"

namespace understudy {

std::unique_ptr<RobotPort> OpenPort(const Participant& participant, const RobotSpec& spec) {
  if (spec.family == WireFamily::kGo) return std::make_unique<GoPort>(participant, spec);
  return std::make_unique<HgPort>(participant, spec);
}

}  // namespace understudy
