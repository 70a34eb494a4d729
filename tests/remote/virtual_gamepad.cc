// Preloaded into understudy-remote: plugs a gamepad of SDL's own making in and out, as a test tells
// it line by line through the FIFO that UNDERSTUDY_VIRTUAL_GAMEPAD names. So the program as it is
// shipped can be tested on machines without /dev/uinput. "broken" instead of a FIFO: a system that
// has no gamepads to offer.
//
//   plug | unplug | button INDEX 0|1 | axis INDEX -32768..32767 | hat INDEX BITS
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <string>

#include <SDL2/SDL.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <unistd.h>

namespace {

// As the driver of most gamepads on Linux has them; triggers are axes that rest at their lower end.
constexpr int kAxes = 6;
constexpr int kTriggers[] = {2, 5};
constexpr int kButtons = 11;
constexpr int kHats = 1;

const char* Wish() {
  const char* wish = std::getenv("UNDERSTUDY_VIRTUAL_GAMEPAD");
  return wish == nullptr ? "" : wish;
}

// Plugged in until it is told otherwise; all of it in SDL's own thread.
class Gamepad {
 public:
  void Obey() {
    if (fifo_ < 0) fifo_ = ::open(Wish(), O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    char bytes[512];
    ssize_t count = 0;
    while (fifo_ >= 0 && (count = ::read(fifo_, bytes, sizeof bytes)) > 0) {
      heard_.append(bytes, static_cast<std::size_t>(count));
    }
    for (std::size_t end = 0; (end = heard_.find('\n')) != std::string::npos;) {
      Do(std::istringstream(heard_.substr(0, end)));
      heard_.erase(0, end + 1);
    }
  }

 private:
  void Do(std::istringstream line) {
    std::string what;
    int index = 0;
    int value = 0;
    line >> what >> index >> value;
    if (what == "plug") Plug();
    if (what == "unplug") Unplug();
    if (what == "button") SDL_JoystickSetVirtualButton(joystick_, index, static_cast<Uint8>(value));
    if (what == "axis") SDL_JoystickSetVirtualAxis(joystick_, index, static_cast<Sint16>(value));
    if (what == "hat") SDL_JoystickSetVirtualHat(joystick_, index, static_cast<Uint8>(value));
  }

  // Of a type whose buttons SDL does not guess: which is which has to come from a mapping.
  void Plug() {
    SDL_VirtualJoystickDesc desc{};
    desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    desc.type = SDL_JOYSTICK_TYPE_UNKNOWN;
    desc.naxes = kAxes;
    desc.nbuttons = kButtons;
    desc.nhats = kHats;
    desc.name = "Red Gamepad";
    desc.vendor_id = 0x5eed;
    desc.product_id = 1;
    joystick_ = SDL_JoystickOpen(SDL_JoystickAttachVirtualEx(&desc));
    for (const int trigger : kTriggers) {
      SDL_JoystickSetVirtualAxis(joystick_, trigger, SDL_JOYSTICK_AXIS_MIN);
    }
  }

  void Unplug() {
    const SDL_JoystickID id = SDL_JoystickInstanceID(joystick_);
    for (int device = 0; device < SDL_NumJoysticks(); ++device) {
      if (SDL_JoystickGetDeviceInstanceID(device) == id) SDL_JoystickDetachVirtual(device);
    }
    SDL_JoystickClose(joystick_);
    joystick_ = nullptr;
  }

  int fifo_ = -1;
  std::string heard_;
  SDL_Joystick* joystick_ = nullptr;
};

Gamepad& TheGamepad() {
  static Gamepad gamepad;
  return gamepad;
}

template <typename Function>
Function* Real(const char* name, Function* /*of this type*/) {
  return reinterpret_cast<Function*>(::dlsym(RTLD_NEXT, name));
}

}  // namespace

// In front of SDL's own; both are called by who owns the gamepads alone.
extern "C" int SDL_Init(Uint32 flags) {
  if (std::strcmp(Wish(), "broken") == 0) return SDL_SetError("there is no such thing here");
  const int code = Real("SDL_Init", &SDL_Init)(flags);
  TheGamepad().Obey();
  return code;
}

extern "C" int SDL_PollEvent(SDL_Event* event) {
  TheGamepad().Obey();
  static const auto real = Real("SDL_PollEvent", &SDL_PollEvent);
  return real(event);
}
