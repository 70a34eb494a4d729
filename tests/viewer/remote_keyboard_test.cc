#include "viewer/remote_keyboard.h"

#include <GLFW/glfw3.h>

#include "gtest/gtest.h"
#include "robot/remote_keys.h"

namespace understudy {
namespace {

TEST(RemoteKeyboardTest, PressesKeysTogether) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_W);
  keyboard.Press(GLFW_KEY_B);
  EXPECT_EQ(RemoteKeyNames(keyboard.Read().keys), "L2+B");
  keyboard.Release(GLFW_KEY_W);
  EXPECT_EQ(RemoteKeyNames(keyboard.Read().keys), "B");
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

TEST(RemoteKeyboardTest, IsThereEvenWhereNothingIsPressed) {
  RemoteKeyboard keyboard;
  keyboard.Press(GLFW_KEY_Z);
  keyboard.Press(GLFW_KEY_A);
  keyboard.ReleaseAll();
  EXPECT_TRUE(keyboard.Read().there);
  EXPECT_EQ(keyboard.Read().keys, 0);
}

}  // namespace
}  // namespace understudy
