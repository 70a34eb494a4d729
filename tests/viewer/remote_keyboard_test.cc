#include "viewer/remote_keyboard.h"

#include <GLFW/glfw3.h>

#include "gtest/gtest.h"
#include "robot/remote_keys.h"

namespace understudy::viewer {
namespace {

TEST(RemoteKeyboardTest, PressesKeysTogether) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_W);
  keyboard.Press(GLFW_KEY_B);
  EXPECT_EQ(robot::RemoteKeyNames(keyboard.Read().keys), "L2+B");
  keyboard.Release(GLFW_KEY_W);
  EXPECT_EQ(robot::RemoteKeyNames(keyboard.Read().keys), "B");
}

TEST(RemoteKeyboardTest, MovesTheSticks) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_E);
  keyboard.Press(GLFW_KEY_J);
  EXPECT_EQ(keyboard.Read().ly, 1);
  EXPECT_EQ(keyboard.Read().rx, -1);
  keyboard.Press(GLFW_KEY_D);
  EXPECT_EQ(keyboard.Read().ly, 0) << "both ways at once is neither";
}

TEST(RemoteKeyboardTest, KnowsEveryKeyOfTheTerminals) {
  RemoteKeyboard keyboard;
  for (const int key : {GLFW_KEY_Q, GLFW_KEY_W, GLFW_KEY_P, GLFW_KEY_O, GLFW_KEY_A, GLFW_KEY_B,
                        GLFW_KEY_X, GLFW_KEY_Y, GLFW_KEY_UP, GLFW_KEY_DOWN, GLFW_KEY_LEFT,
                        GLFW_KEY_RIGHT, GLFW_KEY_ENTER, GLFW_KEY_TAB, GLFW_KEY_1, GLFW_KEY_2}) {
    keyboard.Press(key);
  }
  EXPECT_EQ(keyboard.Read().keys, 0xFFFF);
}

TEST(RemoteKeyboardTest, MovesAStickHalfTheWayWithShift) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_S, true);
  EXPECT_EQ(keyboard.Read().lx, -0.5);
}

TEST(RemoteKeyboardTest, IsThereEvenWhereNothingIsPressed) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_Z);
  keyboard.Press(GLFW_KEY_A);
  keyboard.ReleaseAll();
  EXPECT_TRUE(keyboard.Read().there);
  EXPECT_EQ(keyboard.Read().keys, 0);
}

}  // namespace
}  // namespace understudy::viewer
