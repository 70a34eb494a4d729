// Refuses to start beside another writer of rt/lowstate.
#pragma once

#include "bus/participant.h"
#include "config/config.h"
#include "time/clock.h"
#include "wire/strangers.h"

namespace understudy::run {

// Returns if no other participant writes rt/lowstate and no other robot of this program began to
// start before this one (wire/robot_rank.h), or if it has only a silent writer and the
// configuration allows that. The listening time counts from `since`, when the watch began. A writer
// that has sent nothing gets the same time again. It is that of the configuration; in a
// `private_network`, where nobody is before the robot speaks, there is none. Throws NeighbourError.
void RefuseToStartBeside(wire::StrangerWatch* watch, time::Clock::Time since,
                         const bus::Participant& participant, const config::GuardConfig& guard,
                         bool private_network, time::Clock* clock);

}  // namespace understudy::run
