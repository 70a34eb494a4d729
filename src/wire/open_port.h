// The port that a robot needs.
#ifndef UNDERSTUDY_WIRE_OPEN_PORT_H_
#define UNDERSTUDY_WIRE_OPEN_PORT_H_

#include <memory>

#include "bus/participant.h"
#include "robot/robot_spec.h"
#include "wire/robot_port.h"

namespace understudy::wire {

// A GoPort or an HgPort, by spec.family; throws what they throw. Both arguments must outlive it.
std::unique_ptr<RobotPort> OpenPort(const bus::Participant& participant,
                                    const robot::RobotSpec& spec);

}  // namespace understudy::wire

#endif  // UNDERSTUDY_WIRE_OPEN_PORT_H_
