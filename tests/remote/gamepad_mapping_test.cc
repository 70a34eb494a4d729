#include "remote/gamepad_mapping.h"

#include <algorithm>
#include <bit>
#include <string>

#include <gtest/gtest.h>

#include "robot/remote_keys.h"
#include "wire/remote_codec.h"

namespace understudy::remote {
namespace {

GamepadState Pressed(GamepadButton button) {
  GamepadState pad;
  pad.pressed[static_cast<std::size_t>(button)] = true;
  return pad;
}

float FloatAt(const std::array<std::uint8_t, 40>& bytes, std::size_t at) {
  std::array<std::uint8_t, 4> four{};
  std::copy_n(bytes.begin() + static_cast<std::ptrdiff_t>(at), 4, four.begin());
  return std::bit_cast<float>(four);
}

// The table of docs/reference/remote.md, with the bits as in the vendor's unitree_joystick.hpp.
TEST(GamepadMappingTest, EveryButtonIsItsKey) {
  struct Row {
    GamepadButton button;
    const char* key;
    std::uint8_t low, high;  // bytes 2 and 3 of wireless_remote
  };
  constexpr Row kRows[] = {
      {GamepadButton::kRightShoulder, "R1", 0x01, 0},
      {GamepadButton::kLeftShoulder, "L1", 0x02, 0},
      {GamepadButton::kStart, "START", 0x04, 0},
      {GamepadButton::kBack, "SELECT", 0x08, 0},
      {GamepadButton::kLeftStick, "F1", 0x40, 0},
      {GamepadButton::kRightStick, "F2", 0x80, 0},
      {GamepadButton::kA, "A", 0, 0x01},
      {GamepadButton::kB, "B", 0, 0x02},
      {GamepadButton::kX, "X", 0, 0x04},
      {GamepadButton::kY, "Y", 0, 0x08},
      {GamepadButton::kUp, "UP", 0, 0x10},
      {GamepadButton::kRight, "RIGHT", 0, 0x20},
      {GamepadButton::kDown, "DOWN", 0, 0x40},
      {GamepadButton::kLeft, "LEFT", 0, 0x80},
      {GamepadButton::kGuide, "", 0, 0},
  };
  EXPECT_EQ(std::size(kRows), kGamepadButtons);
  for (const Row& row : kRows) {
    const robot::RemoteReading reading = ReadGamepad(Pressed(row.button), kDeadZone, 0);
    EXPECT_EQ(robot::RemoteKeyNames(reading.keys), row.key);
    const auto bytes = wire::EncodeRemote(reading);
    EXPECT_EQ(bytes[0], 0x55);
    EXPECT_EQ(bytes[1], 0x51);
    EXPECT_EQ(bytes[2], row.low) << row.key;
    EXPECT_EQ(bytes[3], row.high) << row.key;
    EXPECT_TRUE(std::all_of(bytes.begin() + 4, bytes.end(), [](auto byte) { return byte == 0; }))
        << row.key;
  }
}

TEST(GamepadMappingTest, TriggersAreL2AndR2) {
  GamepadState pad;
  pad.left_trigger = 1;
  EXPECT_EQ(robot::RemoteKeyNames(ReadGamepad(pad, kDeadZone, 0).keys), "L2");
  pad.right_trigger = 0.6;
  const auto bytes = wire::EncodeRemote(ReadGamepad(pad, kDeadZone, 0));
  EXPECT_EQ(bytes[2], 0x30);
  EXPECT_EQ(FloatAt(bytes, 16), 1.0F);
}

TEST(GamepadMappingTest, ATriggerHalfPulledStaysWhatItWas) {
  GamepadState pad;
  pad.left_trigger = 0.45;
  EXPECT_EQ(ReadGamepad(pad, kDeadZone, 0).keys, 0);
  EXPECT_EQ(robot::RemoteKeyNames(ReadGamepad(pad, kDeadZone, 0x20).keys), "L2");
  pad.left_trigger = 0.39;
  EXPECT_EQ(ReadGamepad(pad, kDeadZone, 0x20).keys, 0);
}

TEST(GamepadMappingTest, SticksAreRightAndForwardWhereTheWireHasThem) {
  GamepadState pad;
  pad.left_x = 1;
  pad.right_x = -1;
  EXPECT_EQ(FloatAt(wire::EncodeRemote(ReadGamepad(pad, kDeadZone, 0)), 4), 1.0F);
  EXPECT_EQ(FloatAt(wire::EncodeRemote(ReadGamepad(pad, kDeadZone, 0)), 8), -1.0F);
  pad = {};
  pad.left_y = -1;  // away from the person
  pad.right_y = 1;
  EXPECT_EQ(FloatAt(wire::EncodeRemote(ReadGamepad(pad, kDeadZone, 0)), 20), 1.0F);
  EXPECT_EQ(FloatAt(wire::EncodeRemote(ReadGamepad(pad, kDeadZone, 0)), 12), -1.0F);
}

TEST(GamepadMappingTest, AStickNearItsMiddleIsInIt) {
  GamepadState pad;
  pad.left_x = 0.06;
  pad.left_y = -0.07;
  const robot::RemoteReading reading = ReadGamepad(pad, 0.1, 0);
  EXPECT_EQ(reading.lx, 0);
  EXPECT_EQ(reading.ly, 0);
  EXPECT_FALSE(std::signbit(reading.ly));
}

TEST(GamepadMappingTest, AStickBeginsAtZeroBeyondTheDeadZoneAndReachesItsEnd) {
  GamepadState pad;
  pad.left_x = 0.2 + 1e-6;
  EXPECT_NEAR(ReadGamepad(pad, 0.2, 0).lx, 0, 1e-5);
  pad.left_x = 0.6;
  EXPECT_NEAR(ReadGamepad(pad, 0.2, 0).lx, 0.5, 1e-9);
  pad.left_x = 1;
  EXPECT_EQ(ReadGamepad(pad, 0.2, 0).lx, 1);
  EXPECT_NEAR(ReadGamepad(pad, 0, 0).lx, 1, 1e-9);
}

TEST(GamepadMappingTest, AStickKeepsItsDirectionAndItsRange) {
  GamepadState pad;
  pad.right_x = 0.4;
  pad.right_y = -0.3;
  const robot::RemoteReading reading = ReadGamepad(pad, 0.1, 0);
  EXPECT_NEAR(reading.ry / reading.rx, 0.75, 1e-9);
  pad.right_x = pad.right_y = 1;  // a stick whose gate is square
  EXPECT_EQ(ReadGamepad(pad, 0.1, 0).rx, 1);
  EXPECT_EQ(ReadGamepad(pad, 0.1, 0).ry, -1);
}

TEST(GamepadMappingTest, AChordIsOneReading) {
  GamepadState pad = Pressed(GamepadButton::kB);
  pad.left_trigger = 1;
  EXPECT_EQ(ReadGamepad(pad, kDeadZone, 0).keys, 0x220);
}

}  // namespace
}  // namespace understudy::remote
