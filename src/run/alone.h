// Refuses to start beside another writer of rt/lowstate.
#pragma once

#include "bus/participant.h"
#include "config/config.h"
#include "time/clock.h"
#include "wire/strangers.h"

namespace understudy::run {

// Returns when no other participant writes rt/lowstate, or there is only a silent writer and the
// configuration allows it. `since`: when the watch was set. A writer that has sent nothing is given
// the same time again. Throws NeighbourError.
void RefuseToStartBeside(wire::StrangerWatch* watch, time::Clock::Time since,
                         const bus::Participant& participant, const config::GuardConfig& guard,
                         time::Clock* clock);

}  // namespace understudy::run
