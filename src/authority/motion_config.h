// The `motion` keys of the configuration: who moves the motors at the start.
#pragma once

#include <string>

namespace understudy::authority {

inline constexpr const char* kNoService = "none";

struct MotionConfig {
  std::string service;  // alias; "" = the first that the firmware has, kNoService = none
  bool fight = false;   // also follow rt/lowcmd while a motion service is on
};

}  // namespace understudy::authority
