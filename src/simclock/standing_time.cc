#include "simclock/standing_time.h"

#include <dlfcn.h>

namespace understudy::simclock {
namespace {

void Stand(bool stand) {
  static auto* const in_library =
      reinterpret_cast<void (*)(bool)>(::dlsym(RTLD_DEFAULT, "simclock_stand"));
  if (in_library != nullptr) in_library(stand);
}

}  // namespace

StandingTime::StandingTime() { Stand(true); }
StandingTime::~StandingTime() { Stand(false); }

}  // namespace understudy::simclock
