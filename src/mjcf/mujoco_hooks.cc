#include "mjcf/mujoco_hooks.h"

#include <array>
#include <cstring>
#include <string>

#include <mujoco/mujoco.h>

#include "base/errors.h"

namespace understudy::mjcf {
namespace {

struct Warning {
  std::array<char, 512> text{};
  bool is_new = false;
};

// MuJoCo's hooks are plain C globals; it calls them in the thread that called MuJoCo.
thread_local Warning last_warning;

// mju_error must not return. Throwing is safe: MuJoCo's C code owns only its arena at these points,
// and the model is abandoned.
void OnError(const char* message) { throw ModelError(std::string("MuJoCo: ") + message); }

void OnWarning(const char* message) {
  std::strncpy(last_warning.text.data(), message, last_warning.text.size() - 1);
  last_warning.is_new = true;
}

}  // namespace

void InstallMujocoHooks() {
  static const bool installed = [] {
    mju_user_error = OnError;
    mju_user_warning = OnWarning;
    return true;
  }();
  (void)installed;
}

std::string_view TakeMujocoWarning() {
  if (!last_warning.is_new) return "";
  last_warning.is_new = false;
  return last_warning.text.data();
}

}  // namespace understudy::mjcf
