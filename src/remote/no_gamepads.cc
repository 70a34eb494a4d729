// Replaces gamepads.cc in a build without SDL.
#include <utility>

#include "base/errors.h"
#include "remote/gamepads.h"

namespace understudy::remote {
namespace {

constexpr char kMissing[] = "built without gamepads: apt-get install libsdl2-dev, and build again";

}  // namespace

class Gamepads::Sdl {
 public:
  std::vector<std::string> news{kMissing};
};

Gamepads::Gamepads(const GamepadChoice& choice) : sdl_(std::make_unique<Sdl>()) {
  if (!choice.which.empty() || !choice.mapping_file.empty()) throw SetupError(kMissing);
}

Gamepads::~Gamepads() = default;

std::optional<GamepadState> Gamepads::Poll() { return std::nullopt; }

std::string Gamepads::in_use() const { return ""; }

std::vector<std::string> Gamepads::TakeNews() { return std::exchange(sdl_->news, {}); }

std::string Gamepads::List() const { return std::string(kMissing) + "\n"; }

}  // namespace understudy::remote
