// Reads the gamepads of this machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remote/gamepad_mapping.h"

namespace understudy::remote {

struct GamepadChoice {
  std::string which{};         // a number of the list, from 1, or part of a name; "" for any
  std::string mapping_file{};  // further mappings in SDL's format; "" for none
};

// Uses the first gamepad that fits the choice until it is unplugged, then the next. Having none is
// not an error. Does not touch signals or the screen and starts no thread.
class Gamepads {
 public:
  // Throws ConfigError for a mapping file that cannot be read. If the system does not support
  // gamepads there are none, and TakeNews() has the reason.
  explicit Gamepads(const GamepadChoice& choice);
  ~Gamepads();
  Gamepads(const Gamepads&) = delete;
  Gamepads& operator=(const Gamepads&) = delete;

  // Processes plugging and unplugging, and returns the state of the gamepad in use; nullopt while
  // there is none. Does not wait.
  std::optional<GamepadState> Poll();

  // Returns its name; "" while there is none.
  std::string in_use() const;

  // Returns the messages since the last call, one line each.
  std::vector<std::string> TakeNews();

  // Lists all plugged-in gamepads and joysticks: number, name, and whether the buttons are known.
  std::string List() const;

 private:
  class Sdl;
  std::unique_ptr<Sdl> sdl_;
};

}  // namespace understudy::remote
