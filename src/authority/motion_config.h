// Who moves the motors when a run begins.
#pragma once

#include <string>

namespace understudy::authority {

inline constexpr const char* kNoService = "none";

struct MotionConfig {
  std::string service;  // alias; "" = the first that the firmware has, kNoService = none
  bool fight = false;   // follow rt/lowcmd although a motion service is on
};

}  // namespace understudy::authority
