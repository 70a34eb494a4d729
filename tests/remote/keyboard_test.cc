#include "remote/keyboard.h"

#include <set>

#include <gtest/gtest.h>

namespace understudy::remote {
namespace {

using Kind = TerminalEvent::Kind;

std::string Names(const Keyboard& keyboard, double t) {
  return robot::RemoteKeyNames(keyboard.Read(t).keys);
}

// A keyboard whose terminal tells releases.
class KittyTest : public ::testing::Test {
 protected:
  KittyTest() { keyboard_.Take({.kind = Kind::kReportsReleases}, 0); }
  void Press(char32_t key, double t) { keyboard_.Take({.key = key}, t); }
  void Release(char32_t key, double t) { keyboard_.Take({.kind = Kind::kRelease, .key = key}, t); }

  Keyboard keyboard_;
};

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

TEST(KeyboardTest, WithoutReleasesAKeyIsUpWhenItIsNotHeardAgain) {
  Keyboard keyboard;
  keyboard.Take({.key = U'e'}, 0);
  EXPECT_EQ(keyboard.Read(0.69).ly, 1);
  EXPECT_EQ(keyboard.Read(0.71).ly, 0);
}

TEST(KeyboardTest, WithoutReleasesAHeldKeyStaysDownWhileItRepeats) {
  Keyboard keyboard;
  keyboard.Take({.key = U'e'}, 0);
  for (double t = 0.5; t < 2; t += 0.033) {
    keyboard.Take({.key = U'e'}, t);
    EXPECT_EQ(keyboard.Read(t + 0.032).ly, 1);
  }
  EXPECT_EQ(keyboard.Read(2.25).ly, 0);
}

TEST(KeyboardTest, WithoutReleasesOneKeySoonAfterAnotherIsAChord) {
  Keyboard keyboard;
  keyboard.Take({.key = U'w'}, 0);
  keyboard.Take({.key = U'b'}, 0.3);
  EXPECT_EQ(Names(keyboard, 0.3), "L2+B");
}

TEST_F(KittyTest, AKeyIsDownUntilItIsReleased) {
  Press(U'w', 0);
  Press(U'b', 5);
  EXPECT_EQ(Names(keyboard_, 100), "L2+B");
  Release(U'w', 100);
  EXPECT_EQ(Names(keyboard_, 100), "B");
  Release(U'b', 101);
  EXPECT_EQ(Names(keyboard_, 101), "");
}

TEST_F(KittyTest, APressThatIsOverAtOnceIsSeen) {
  Press(U'b', 1);
  Release(U'b', 1);
  EXPECT_EQ(Names(keyboard_, 1.04), "B");
  EXPECT_EQ(Names(keyboard_, 1.06), "");
}

TEST_F(KittyTest, LetsGoWhatItCanNotHearOf) {
  Press(U'w', 0);
  keyboard_.Take({.kind = Kind::kFocusLost}, 1);
  EXPECT_EQ(Names(keyboard_, 1), "");
}

TEST_F(KittyTest, ShiftGoesHalfTheWay) {
  keyboard_.Take({.key = U'd', .shift = true}, 0);
  EXPECT_EQ(keyboard_.Read(1).ly, -0.5);
}

TEST_F(KittyTest, OppositeKeysMeetInTheMiddle) {
  Press(U's', 0);
  Press(U'f', 0);
  EXPECT_EQ(keyboard_.Read(1).lx, 0);
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

TEST(KeyboardTest, ControlCEndsAndPressesNothing) {
  Keyboard keyboard;
  keyboard.Take({.key = U'b', .control = true}, 0);
  EXPECT_FALSE(keyboard.wants_to_quit());
  EXPECT_EQ(Names(keyboard, 0), "");
  keyboard.Take({.key = U'c', .control = true}, 0);
  EXPECT_TRUE(keyboard.wants_to_quit());
}

}  // namespace
}  // namespace understudy::remote
