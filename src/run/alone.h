// That no two robots are on one network.
#ifndef UNDERSTUDY_RUN_ALONE_H_
#define UNDERSTUDY_RUN_ALONE_H_

#include "bus/participant.h"
#include "config/config.h"
#include "time/clock.h"
#include "wire/strangers.h"

namespace understudy::run {

// Returns when nobody else is a robot here, or only may be one and the configuration allows that.
// `since`: when the watch was set. Who has a writer is given the same time again to speak.
// Throws NeighbourError.
void RefuseToStartBeside(wire::StrangerWatch* watch, time::Clock::Time since,
                         const bus::Participant& participant, const config::GuardConfig& guard,
                         time::Clock* clock);

}  // namespace understudy::run

#endif  // UNDERSTUDY_RUN_ALONE_H_
