#include "viewer/pointer.h"

#include <cmath>

#include <GLFW/glfw3.h>

#include "viewer_test.h"

namespace understudy::viewer {
namespace {

using Kind = WindowEvent::Kind;

// Looks along y at the ball, from 10 m; the window is as wide as high.
class PointerTest : public test::MujocoTest {
 protected:
  PointerTest() {
    stage_.Show(BallAt(0));
    Look();
  }

  static CameraChoice Choice() {
    CameraChoice choice;
    choice.azimuth = 90;
    choice.elevation = 0;
    choice.distance = 10;
    return choice;
  }
  void Look() {
    stage_.Compose(camera_.camera(), {}, nullptr);
    // What drawing does: both eyes become one.
    stage_.scene()->stereo = mjSTEREO_NONE;
  }
  void Do(Kind kind, double x, double y, int button = GLFW_MOUSE_BUTTON_LEFT, bool control = false,
          bool shift = false) {
    WindowEvent event;
    event.kind = kind;
    event.code = button;
    event.x = x;
    event.y = y;
    event.control = control;
    event.shift = shift;
    pointer_.Take(event, 1.0, time_ += 0.05, &stage_, &camera_);
    Look();
  }
  void DoubleClick(double x, double y, int button = GLFW_MOUSE_BUTTON_LEFT) {
    for (int i = 0; i < 2; ++i) {
      Do(Kind::kButtonDown, x, y, button);
      Do(Kind::kButtonUp, x, y, button);
    }
    time_ += 1;
  }

  Stage stage_{BallModel()};
  CameraOperator camera_{stage_, Choice(), {.width = 100, .height = 100}};
  Pointer pointer_;
  double time_ = 0;
};

TEST_F(PointerTest, SelectsTheBodyUnderADoubleClick) {
  DoubleClick(0.5, 0.55);
  EXPECT_EQ(pointer_.selected(), stage_.Body("ball"));
  DoubleClick(0.02, 0.02);
  EXPECT_EQ(pointer_.selected(), 0);
}

TEST_F(PointerTest, DoesNotSelectAtASingleClick) {
  Do(Kind::kButtonDown, 0.5, 0.55);
  Do(Kind::kButtonUp, 0.5, 0.55);
  EXPECT_EQ(pointer_.selected(), 0);
}

TEST_F(PointerTest, TurnsTheCameraWithoutAGrip) {
  const double azimuth = camera_.camera()->azimuth;
  Do(Kind::kButtonDown, 0.5, 0.5);
  Do(Kind::kMove, 0.7, 0.5);
  EXPECT_NE(camera_.camera()->azimuth, azimuth);
  EXPECT_FALSE(pointer_.grip());
}

TEST_F(PointerTest, LetsTheCameraBeWhileNoButtonIsDown) {
  const double azimuth = camera_.camera()->azimuth;
  Do(Kind::kMove, 0.7, 0.5);
  EXPECT_EQ(camera_.camera()->azimuth, azimuth);
}

TEST_F(PointerTest, GoesNearerWithTheWheel) {
  WindowEvent event;
  event.kind = Kind::kScroll;
  event.scroll = 1;
  pointer_.Take(event, 1, 0, &stage_, &camera_);
  EXPECT_LT(camera_.camera()->distance, 10);
}

TEST_F(PointerTest, PullsTheSelectedBodyWhereItWasTakenHoldOf) {
  DoubleClick(0.5, 0.55);
  Do(Kind::kButtonDown, 0.1, 0.1, GLFW_MOUSE_BUTTON_LEFT, true);
  ASSERT_TRUE(pointer_.grip());
  const Grip before = *pointer_.grip();
  EXPECT_EQ(before.body, stage_.Body("ball"));
  EXPECT_NEAR(std::hypot(before.at[0], before.at[1], before.at[2]), 1, 0.02) << "on its skin";
  EXPECT_NEAR(before.to[1], -1, 0.1) << "on the camera's side";

  Do(Kind::kMove, 0.2, 0.1, GLFW_MOUSE_BUTTON_LEFT, true);
  const Grip after = *pointer_.grip();
  EXPECT_GT(after.to[0], before.to[0] + 0.1) << "to the right is along x";
  EXPECT_NEAR(after.to[1], before.to[1], 1e-6);
  EXPECT_EQ(after.at, before.at);

  Do(Kind::kMove, 0.2, 0.0, GLFW_MOUSE_BUTTON_LEFT, true);
  EXPECT_GT(pointer_.grip()->to[2], after.to[2] + 0.1) << "up is up";
  Do(Kind::kMove, 0.2, 0.1, GLFW_MOUSE_BUTTON_LEFT, true, /*shift=*/true);
  EXPECT_LT(pointer_.grip()->to[1], after.to[1] - 0.1) << "with shift, down is nearer";

  Do(Kind::kButtonUp, 0.2, 0.1);
  EXPECT_FALSE(pointer_.grip());
}

TEST_F(PointerTest, HoldsNothingWhereNothingIsSelected) {
  Do(Kind::kButtonDown, 0.5, 0.5, GLFW_MOUSE_BUTTON_LEFT, true);
  EXPECT_FALSE(pointer_.grip());
}

TEST_F(PointerTest, LooksAtThePointOfARightDoubleClick) {
  DoubleClick(0.5, 0.5, GLFW_MOUSE_BUTTON_RIGHT);
  // 0.55 m above the middle of the ball.
  EXPECT_NEAR(camera_.camera()->lookat[1], -std::sqrt(1 - 0.55 * 0.55), 0.02);
}

}  // namespace
}  // namespace understudy::viewer
