// A robot drawn at random, on a stand, that is excited in whole ticks of the emulator.
#pragma once

#include <map>
#include <string>

#include "config/config.h"
#include "identify/excitation.h"
#include "identify/identify.h"
#include "identify/parameters.h"
#include "identify/replay.h"
#include "identify/samples.h"

namespace understudy::identify {

struct Drawn {
  Samples samples{};                      // as its encoders read, with their noise
  std::map<std::string, double> truth{};  // "armature FR_hip": as drawn
};

// One of config/robots, its joints' armature, damping and friction, and its delay, drawn from
// `seed`.
Drawn Draw(const std::string& robot, int seed, const ExcitationSpec& excitation);

// What would be known of it without the draws.
config::Config Known(const std::string& robot);
Replay ReplayOf(const config::Config& config);

// What is found of it; a quarter of the windows is held out.
Identification IdentifiedBy(const Drawn& drawn, const Options& options, bool by_joint);

inline const ExcitationSpec kShortExcitation{
    .amplitude = 0.4, .from_hz = 0.3, .to_hz = 6, .seconds = 6};

}  // namespace understudy::identify
