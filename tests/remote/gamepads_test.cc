#include "remote/gamepads.h"

#include <memory>

#include <SDL2/SDL.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/errors.h"
#include "tests/support/temporary_folder.h"

namespace understudy::remote {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

// A gamepad of SDL's own making, plugged in from construction to destruction.
class VirtualGamepad {
 public:
  explicit VirtualGamepad(const char* name,
                          SDL_JoystickType type = SDL_JOYSTICK_TYPE_GAMECONTROLLER) {
    SDL_VirtualJoystickDesc desc{};
    desc.version = SDL_VIRTUAL_JOYSTICK_DESC_VERSION;
    desc.type = static_cast<Uint16>(type);
    desc.naxes = SDL_CONTROLLER_AXIS_MAX;
    desc.nbuttons = SDL_CONTROLLER_BUTTON_MAX;
    desc.name = name;
    desc.vendor_id = 0x5eed;
    desc.product_id = 1;
    joystick_ = SDL_JoystickOpen(SDL_JoystickAttachVirtualEx(&desc));
    EXPECT_NE(joystick_, nullptr) << SDL_GetError();
  }
  ~VirtualGamepad() {
    const SDL_JoystickID id = SDL_JoystickInstanceID(joystick_);
    for (int device = 0; device < SDL_NumJoysticks(); ++device) {
      if (SDL_JoystickGetDeviceInstanceID(device) == id) SDL_JoystickDetachVirtual(device);
    }
    SDL_JoystickClose(joystick_);
  }
  VirtualGamepad(const VirtualGamepad&) = delete;
  VirtualGamepad& operator=(const VirtualGamepad&) = delete;

  void Press(SDL_GameControllerButton button, bool down = true) {
    SDL_JoystickSetVirtualButton(joystick_, button, down ? 1 : 0);
  }
  void Move(SDL_GameControllerAxis axis, Sint16 value) {
    SDL_JoystickSetVirtualAxis(joystick_, axis, value);
  }

 private:
  SDL_Joystick* joystick_ = nullptr;
};

// Only pads of ours, whatever this machine has.
class GamepadsTest : public ::testing::Test {
 protected:
  GamepadsTest() { SDL_SetHint(SDL_HINT_GAMECONTROLLER_IGNORE_DEVICES_EXCEPT, "0x5eed/0x0001"); }
};

TEST_F(GamepadsTest, AbsenceIsNoError) {
  Gamepads gamepads({});
  EXPECT_FALSE(gamepads.Poll());
  EXPECT_EQ(gamepads.in_use(), "");
  EXPECT_THAT(gamepads.List(), HasSubstr("no gamepad"));
}

TEST_F(GamepadsTest, APadThatIsPluggedInIsUsed) {
  Gamepads gamepads({});
  EXPECT_FALSE(gamepads.Poll());
  VirtualGamepad pad("Red Pad");
  ASSERT_TRUE(gamepads.Poll());
  EXPECT_EQ(gamepads.in_use(), "Red Pad");
  EXPECT_THAT(gamepads.TakeNews(), Contains("Red Pad is the remote controller"));
  pad.Press(SDL_CONTROLLER_BUTTON_B);
  pad.Move(SDL_CONTROLLER_AXIS_LEFTY, -32768);
  pad.Move(SDL_CONTROLLER_AXIS_TRIGGERLEFT, 32767);
  const std::optional<GamepadState> state = gamepads.Poll();
  ASSERT_TRUE(state);
  const robot::RemoteReading reading = ReadGamepad(*state, kDeadZone, 0);
  EXPECT_EQ(reading.keys, 0x220);
  EXPECT_EQ(reading.ly, 1);
  EXPECT_EQ(reading.lx, 0);
}

TEST_F(GamepadsTest, APadThatIsUnpluggedHoldsNothingAndMayComeBack) {
  Gamepads gamepads({});
  auto pad = std::make_unique<VirtualGamepad>("Red Pad");
  pad->Press(SDL_CONTROLLER_BUTTON_A);
  ASSERT_TRUE(gamepads.Poll());
  pad.reset();
  EXPECT_FALSE(gamepads.Poll());
  EXPECT_THAT(gamepads.TakeNews(), Contains("Red Pad has gone"));
  pad = std::make_unique<VirtualGamepad>("Red Pad");
  EXPECT_TRUE(gamepads.Poll());
}

TEST_F(GamepadsTest, TheFirstOfSeveralIsUsedUntilItGoes) {
  Gamepads gamepads({});
  auto first = std::make_unique<VirtualGamepad>("Red Pad");
  EXPECT_TRUE(gamepads.Poll());
  const VirtualGamepad second("Blue Pad");
  EXPECT_TRUE(gamepads.Poll());
  EXPECT_EQ(gamepads.in_use(), "Red Pad");
  first.reset();
  EXPECT_TRUE(gamepads.Poll());
  EXPECT_EQ(gamepads.in_use(), "Blue Pad");
}

TEST_F(GamepadsTest, TheChosenOneIsUsed) {
  for (const char* which : {"blue", "2"}) {
    Gamepads gamepads({.which = which});
    const VirtualGamepad first("Red Pad");
    EXPECT_FALSE(gamepads.Poll()) << which;
    const VirtualGamepad second("Blue Pad");
    EXPECT_TRUE(gamepads.Poll()) << which;
    EXPECT_EQ(gamepads.in_use(), "Blue Pad");
    EXPECT_THAT(gamepads.List(), HasSubstr("2  Blue Pad  known"));
  }
}

TEST_F(GamepadsTest, SaysOnceHowAPadThatIsNotKnownBecomesSo) {
  Gamepads gamepads({});
  const VirtualGamepad wheel("Wheel", SDL_JOYSTICK_TYPE_WHEEL);
  EXPECT_FALSE(gamepads.Poll());
  const std::vector<std::string> news = gamepads.TakeNews();
  EXPECT_THAT(news, Contains(HasSubstr("SDL_GAMECONTROLLERCONFIG")));
  const VirtualGamepad other("Other", SDL_JOYSTICK_TYPE_WHEEL);
  EXPECT_FALSE(gamepads.Poll());
  EXPECT_THAT(gamepads.TakeNews(), Not(Contains(HasSubstr("Wheel"))));
  EXPECT_THAT(gamepads.List(), HasSubstr("unknown, guid "));
}

TEST_F(GamepadsTest, AMappingMakesItKnown) {
  std::string guid;
  {
    Gamepads gamepads({});
    const VirtualGamepad wheel("Wheel", SDL_JOYSTICK_TYPE_WHEEL);
    gamepads.Poll();
    const std::string list = gamepads.List();
    guid = list.substr(list.find("guid ") + 5, 32);
  }
  const test::TemporaryFolder folder;
  // What is B of the pad is button 0 of the joystick.
  const std::string file =
      folder.Write("pads.txt", guid + ",Wheel,b:b0,leftx:a1,platform:Linux,\n");
  Gamepads gamepads({.mapping_file = file});
  VirtualGamepad wheel("Wheel", SDL_JOYSTICK_TYPE_WHEEL);
  wheel.Press(SDL_CONTROLLER_BUTTON_A);
  gamepads.Poll();
  const std::optional<GamepadState> state = gamepads.Poll();
  ASSERT_TRUE(state);
  EXPECT_EQ(ReadGamepad(*state, kDeadZone, 0).keys, 0x200);
}

TEST_F(GamepadsTest, RefusesAMappingFileThatIsNotThere) {
  EXPECT_THROW(Gamepads({.mapping_file = "/nowhere/pads.txt"}), ConfigError);
}

}  // namespace
}  // namespace understudy::remote
