#include "wire/open_port.h"

#include "wire/go_port.h"
#include "wire/hg_port.h"

namespace understudy::wire {

std::unique_ptr<RobotPort> OpenPort(const bus::Participant& participant,
                                    const robot::RobotSpec& spec) {
  if (spec.family == robot::WireFamily::kGo) return std::make_unique<GoPort>(participant, spec);
  return std::make_unique<HgPort>(participant, spec);
}

}  // namespace understudy::wire
