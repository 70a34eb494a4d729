#include "viewer/camera_operator.h"

#include <cmath>
#include <numbers>
#include <string>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "viewer_test.h"

namespace understudy::viewer {
namespace {

class CameraOperatorTest : public test::MujocoTest {
 protected:
  CameraOperator Make(const CameraChoice& choice, const PictureSize& size = {}) {
    return {stage_, choice, size};
  }

  Stage stage_{BallModel()};
};

TEST_F(CameraOperatorTest, LooksAtTheMiddleOfTheRobotFromWhereAllOfItIsSeen) {
  CameraOperator camera = Make({});
  const Ball ball = stage_.RobotBall();
  EXPECT_NEAR(camera.camera()->lookat[2], ball.center[2], 1e-6);
  const double seen = camera.camera()->distance * std::sin(22.5 * std::numbers::pi / 180);
  EXPECT_GT(seen, 1.05 * ball.radius) << "nothing touches the edge";
  EXPECT_LT(seen, 1.3 * ball.radius);
}

TEST_F(CameraOperatorTest, LooksAheadWhereTheGroundIsNotFlat) {
  std::string world = kBallWorld;
  world.insert(world.find("<camera"), R"(<geom type="box" pos="4 0 0" size="1 1 0.1"/>)");
  const Stage rough(mjcf::ReadBinaryModel(BinaryModel(world), "the test's"));
  const auto ahead = [](const Stage& stage) {
    CameraOperator camera(stage, {}, {});
    return std::cos(camera.camera()->azimuth * std::numbers::pi / 180);
  };
  EXPECT_GT(ahead(rough), 0.5);
  EXPECT_LT(ahead(stage_), -0.5);
}

TEST_F(CameraOperatorTest, StandsFurtherAwayForANarrowPicture) {
  EXPECT_GT(Make({}, {.width = 200, .height = 800}).camera()->distance,
            1.5 * Make({}, {.width = 800, .height = 800}).camera()->distance);
}

TEST_F(CameraOperatorTest, TakesEveryFigureThatIsGiven) {
  CameraOperator camera = Make({.name = {},
                                .azimuth = 10,
                                .elevation = -45,
                                .distance = 3,
                                .lookat = {1, 2, 3},
                                .track = {}});
  EXPECT_EQ(camera.camera()->azimuth, 10);
  EXPECT_EQ(camera.camera()->elevation, -45);
  EXPECT_EQ(camera.camera()->distance, 3);
  EXPECT_EQ(camera.camera()->lookat[1], 2);
}

TEST_F(CameraOperatorTest, FollowsTheRobotAndNotAPoint) {
  CameraOperator follows = Make({});
  CameraOperator stands = Make({.name = {},
                                .azimuth = {},
                                .elevation = {},
                                .distance = {},
                                .lookat = {0, 0, 5},
                                .track = {}});
  stage_.Show(BallAt(0.2));
  follows.Follow(stage_, 10);
  stands.Follow(stage_, 10);
  EXPECT_NEAR(follows.camera()->lookat[0], 0.2, 1e-6);
  EXPECT_EQ(stands.camera()->lookat[0], 0);
}

TEST_F(CameraOperatorTest, FollowsGentlyButGoesAlongWithAReset) {
  CameraOperator camera = Make({});
  stage_.Show(BallAt(0.2));
  camera.Follow(stage_, 0.05);
  EXPECT_GT(camera.camera()->lookat[0], 0);
  EXPECT_LT(camera.camera()->lookat[0], 0.1);
  stage_.Show(BallAt(9));
  camera.Follow(stage_, 0.05);
  EXPECT_NEAR(camera.camera()->lookat[0], 9, 1e-6);
}

TEST_F(CameraOperatorTest, StepsBackFromARobotThatLeavesThePictureUntilSomebodyChooses) {
  SceneState folded = BallAt(0);
  folded.qpos.back() = std::numbers::pi;  // the arm in the ball
  stage_.Show(folded);
  CameraOperator camera = Make({});
  const double near = camera.camera()->distance;
  camera.Follow(stage_, 10);
  EXPECT_EQ(camera.camera()->distance, near);
  stage_.Show(BallAt(0));
  camera.Follow(stage_, 10);
  EXPECT_GT(camera.camera()->distance, 1.1 * near);
  camera.camera()->distance = 1;
  camera.Follow(stage_, 10);
  EXPECT_EQ(camera.camera()->distance, 1);
}

TEST_F(CameraOperatorTest, LooksThroughACameraOfTheModel) {
  CameraChoice choice;
  choice.name = "above";
  CameraOperator camera = Make(choice);
  EXPECT_EQ(camera.camera()->type, mjCAMERA_FIXED);
  EXPECT_EQ(camera.camera()->fixedcamid, 0);
}

TEST_F(CameraOperatorTest, RefusesACameraAndABodyThatAreNotThere) {
  CameraChoice choice;
  choice.name = "front";
  EXPECT_THROW(Make(choice), ModelError);
  choice = {};
  choice.track = "leg";
  EXPECT_THROW(Make(choice), ModelError);
}

}  // namespace
}  // namespace understudy::viewer
