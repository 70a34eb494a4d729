// The gamepads of this machine.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "remote/gamepad_mapping.h"

namespace understudy::remote {

struct GamepadChoice {
  std::string which{};         // a number as in the list, from 1, or part of a name; "" for any
  std::string mapping_file{};  // more mappings in SDL's form; "" for none
};

// From construction to destruction. The first that fits the choice is used until it is unplugged,
// then the next. That there is none, now or ever, is no error. Signals and the screen stay as they
// are; no thread of ours is needed.
class Gamepads {
 public:
  // Throws ConfigError for a mapping file that cannot be read. Where the system has no gamepads to
  // offer there are none, and the news say why.
  explicit Gamepads(const GamepadChoice& choice);
  ~Gamepads();
  Gamepads(const Gamepads&) = delete;
  Gamepads& operator=(const Gamepads&) = delete;

  // Looks what was plugged in and out, and gives the state of the one in use; nullopt while there
  // is none. Does not wait.
  std::optional<GamepadState> Poll();

  // Its name; "" while there is none.
  std::string in_use() const;

  // What happened since the last call, a line each.
  std::vector<std::string> TakeNews();

  // Every gamepad and joystick that is plugged in: number, name, and whether its buttons are known.
  std::string List() const;

 private:
  class Sdl;
  std::unique_ptr<Sdl> sdl_;
};

}  // namespace understudy::remote
