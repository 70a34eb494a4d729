// Reads gamepads with SDL. Only this file includes it.
#include "remote/gamepads.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <set>
#include <string_view>
#include <utility>

#include <SDL2/SDL.h>

#include "base/errors.h"

namespace understudy::remote {
namespace {

static_assert(static_cast<int>(GamepadButton::kRight) == SDL_CONTROLLER_BUTTON_DPAD_RIGHT);
static_assert(static_cast<int>(GamepadButton::kLeftStick) == SDL_CONTROLLER_BUTTON_LEFTSTICK);
static_assert(static_cast<int>(GamepadButton::kBack) == SDL_CONTROLLER_BUTTON_BACK);
static_assert(kGamepadButtons == SDL_CONTROLLER_BUTTON_DPAD_RIGHT + 1);

struct ControllerCloser {
  void operator()(SDL_GameController* controller) const { SDL_GameControllerClose(controller); }
};
using Controller = std::unique_ptr<SDL_GameController, ControllerCloser>;

double AxisOf(SDL_GameController* controller, SDL_GameControllerAxis axis) {
  // From -32768: the two ends alike.
  return std::max(SDL_GameControllerGetAxis(controller, axis) / 32767.0, -1.0);
}

std::string NameOf(int device) {
  const char* name = SDL_JoystickNameForIndex(device);
  return name == nullptr ? "a gamepad without a name" : name;
}

std::string GuidOf(int device) {
  char text[33];
  SDL_JoystickGetGUIDString(SDL_JoystickGetDeviceGUID(device), text, sizeof text);
  return text;
}

std::string Lower(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

bool Fits(const std::string& which, int device) {
  if (which.empty()) return true;
  int number = 0;
  const auto [end, error] = std::from_chars(which.data(), which.data() + which.size(), number);
  if (error == std::errc{} && end == which.data() + which.size()) return number == device + 1;
  return Lower(NameOf(device)).find(Lower(which)) != std::string::npos;
}

}  // namespace

class Gamepads::Sdl {
 public:
  explicit Sdl(GamepadChoice choice) : choice_(std::move(choice)) {
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1");
    SDL_SetHint(SDL_HINT_JOYSTICK_ALLOW_BACKGROUND_EVENTS, "1");
    // With the joysticks, without the screen.
    works_ = SDL_Init(SDL_INIT_GAMECONTROLLER) == 0;
    if (!works_) news_.push_back(std::string("no gamepads: ") + SDL_GetError());
    const std::string& file = choice_.mapping_file;
    if (!file.empty() && SDL_GameControllerAddMappingsFromFile(file.c_str()) < 0) {
      SDL_Quit();
      throw ConfigError(file + ": expected mappings of gamepads in SDL's form: " + SDL_GetError());
    }
  }
  ~Sdl() {
    controller_.reset();
    SDL_Quit();
  }
  Sdl(const Sdl&) = delete;
  Sdl& operator=(const Sdl&) = delete;

  SDL_GameController* Poll() {
    SDL_Event event;
    while (works_ && SDL_PollEvent(&event) != 0) {
      changed_ = changed_ || event.type == SDL_JOYDEVICEADDED || event.type == SDL_JOYDEVICEREMOVED;
    }
    if (std::exchange(changed_, false)) Choose();
    return controller_.get();
  }

  std::string in_use() const { return name_; }
  std::vector<std::string> TakeNews() { return std::exchange(news_, {}); }

 private:
  void Choose() {
    if (controller_ != nullptr && SDL_GameControllerGetAttached(controller_.get()) == SDL_FALSE) {
      news_.push_back(name_ + " has gone");
      controller_.reset();
      name_.clear();
    }
    for (int device = 0; device < SDL_NumJoysticks() && controller_ == nullptr; ++device) {
      if (!Fits(choice_.which, device)) continue;
      if (SDL_IsGameController(device) == SDL_FALSE) {
        TellOfUnknown(device);
        continue;
      }
      controller_.reset(SDL_GameControllerOpen(device));
      if (controller_ == nullptr) {
        news_.push_back(NameOf(device) + ": " + SDL_GetError());
      } else {
        name_ = NameOf(device);
        news_.push_back(name_ + " is the remote controller");
      }
    }
  }

  // Once for each that is plugged in.
  void TellOfUnknown(int device) {
    if (!told_.insert(SDL_JoystickGetDeviceInstanceID(device)).second) return;
    news_.push_back(NameOf(device) +
                    ": which of its buttons is which is not known; say so by --mapping FILE or "
                    "SDL_GAMECONTROLLERCONFIG, for guid " +
                    GuidOf(device));
  }

  GamepadChoice choice_;
  Controller controller_;
  std::string name_;
  std::vector<std::string> news_;
  std::set<SDL_JoystickID> told_;
  bool works_ = false;
  bool changed_ = true;
};

Gamepads::Gamepads(const GamepadChoice& choice) : sdl_(std::make_unique<Sdl>(choice)) {}

Gamepads::~Gamepads() = default;

std::optional<GamepadState> Gamepads::Poll() {
  SDL_GameController* const controller = sdl_->Poll();
  if (controller == nullptr) return std::nullopt;
  GamepadState gamepad;
  for (std::size_t i = 0; i < kGamepadButtons; ++i) {
    gamepad.pressed[i] =
        SDL_GameControllerGetButton(controller, static_cast<SDL_GameControllerButton>(i)) != 0;
  }
  gamepad.left_x = AxisOf(controller, SDL_CONTROLLER_AXIS_LEFTX);
  gamepad.left_y = AxisOf(controller, SDL_CONTROLLER_AXIS_LEFTY);
  gamepad.right_x = AxisOf(controller, SDL_CONTROLLER_AXIS_RIGHTX);
  gamepad.right_y = AxisOf(controller, SDL_CONTROLLER_AXIS_RIGHTY);
  gamepad.left_trigger = AxisOf(controller, SDL_CONTROLLER_AXIS_TRIGGERLEFT);
  gamepad.right_trigger = AxisOf(controller, SDL_CONTROLLER_AXIS_TRIGGERRIGHT);
  return gamepad;
}

std::string Gamepads::in_use() const { return sdl_->in_use(); }

std::vector<std::string> Gamepads::TakeNews() { return sdl_->TakeNews(); }

std::string Gamepads::List() const {
  std::string list;
  for (int device = 0; device < SDL_NumJoysticks(); ++device) {
    list +=
        std::to_string(device + 1) + "  " + NameOf(device) + "  " +
        (SDL_IsGameController(device) == SDL_TRUE ? "known" : "unknown, guid " + GuidOf(device)) +
        "\n";
  }
  return list.empty() ? "no gamepad is plugged in\n" : list;
}

}  // namespace understudy::remote
