#include "remote/keyboard.h"

#include <set>

#include <gtest/gtest.h>

namespace understudy::remote {
namespace {

std::string Names(const Keyboard& keyboard, double t) {
  return robot::RemoteKeyNames(keyboard.Read(t).keys);
}

TEST(KeyboardTest, EveryKeyOfTheRemoteHasOneOfItsOwn) {
  unsigned keys = 0;
  std::set<char32_t> taken;
  for (const KeyBinding& binding : kKeyBindings) {
    EXPECT_EQ(keys & binding.remote_key, 0u) << binding.shown;
    keys |= binding.remote_key;
    EXPECT_TRUE(taken.insert(binding.key).second) << binding.shown;
  }
  EXPECT_EQ(keys, 0xFFFFu);
}

TEST(KeyboardTest, EveryKeyDoesWhatTheTableSays) {
  for (const KeyBinding& binding : kKeyBindings) {
    Keyboard keyboard;
    keyboard.Take({.key = binding.key}, 0);
    const robot::RemoteReading reading = keyboard.Read(0);
    EXPECT_EQ(reading.keys, binding.remote_key);
    if (binding.axis != nullptr) {
      EXPECT_EQ(reading.*binding.axis, binding.to);
    }
  }
}

TEST(KeyboardTest, AKeyIsUpWhenItIsNotHeardAgain) {
  Keyboard keyboard;
  keyboard.Take({.key = U'e'}, 0);
  EXPECT_EQ(keyboard.Read(0.69).ly, 1);
  EXPECT_EQ(keyboard.Read(0.71).ly, 0);
}

TEST(KeyboardTest, AHeldKeyStaysDownWhileItRepeats) {
  Keyboard keyboard;
  keyboard.Take({.key = U'e'}, 0);
  for (double t = 0.5; t < 2; t += 0.033) {
    keyboard.Take({.key = U'e'}, t);
    EXPECT_EQ(keyboard.Read(t + 0.032).ly, 1);
  }
  EXPECT_EQ(keyboard.Read(2.25).ly, 0);
}

TEST(KeyboardTest, OneKeySoonAfterAnotherIsAChord) {
  Keyboard keyboard;
  keyboard.Take({.key = U'w'}, 0);
  keyboard.Take({.key = U'b'}, 0.3);
  EXPECT_EQ(Names(keyboard, 0.3), "L2+B");
}

TEST(KeyboardTest, ShiftGoesHalfTheWay) {
  Keyboard keyboard;
  keyboard.Take({.key = U'd', .shift = true}, 0);
  EXPECT_EQ(keyboard.Read(0).ly, -0.5);
}

TEST(KeyboardTest, OppositeKeysMeetInTheMiddle) {
  Keyboard keyboard;
  keyboard.Take({.key = U's'}, 0);
  keyboard.Take({.key = U'f'}, 0);
  EXPECT_EQ(keyboard.Read(0).lx, 0);
}

TEST(KeyboardTest, SpaceKeepsTheNextKeyUntilItIsSaidAgain) {
  Keyboard keyboard;
  keyboard.Take({.key = U' '}, 0);
  EXPECT_TRUE(keyboard.keeps_next());
  keyboard.Take({.key = U'w'}, 0);
  EXPECT_FALSE(keyboard.keeps_next());
  keyboard.Take({.key = U'b'}, 0);
  EXPECT_EQ(Names(keyboard, 0.1), "L2+B");
  EXPECT_EQ(Names(keyboard, 1000), "L2");
  keyboard.Take({.key = U' '}, 1000);
  keyboard.Take({.key = U'w'}, 1000);
  EXPECT_EQ(Names(keyboard, 1000), "");
}

TEST(KeyboardTest, EscapeLetsEverythingGo) {
  Keyboard keyboard;
  keyboard.Take({.key = U' '}, 0);
  keyboard.Take({.key = U'w'}, 0);
  keyboard.Take({.key = U'e'}, 0);
  keyboard.Take({.key = kEscapeKey}, 0);
  EXPECT_EQ(Names(keyboard, 0), "");
  EXPECT_EQ(keyboard.Read(0).ly, 0);
}

TEST(KeyboardTest, AKeyWithControlPressesNothing) {
  Keyboard keyboard;
  keyboard.Take({.key = U'b', .control = true}, 0);
  EXPECT_EQ(Names(keyboard, 0), "");
}

}  // namespace
}  // namespace understudy::remote
