#include "viewer/stage.h"

#include <cmath>
#include <limits>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "gmock/gmock.h"
#include "mjcf/compile.h"
#include "viewer_test.h"

namespace understudy::viewer {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::ThrowsMessage;

class StageTest : public test::MujocoTest {
 protected:
  // Geoms of the scene of that shape.
  int Count(int type) {
    int count = 0;
    for (int i = 0; i < stage_.scene()->ngeom; ++i) count += stage_.scene()->geoms[i].type == type;
    return count;
  }
  void Compose(const ShowChoice& show) {
    mjvCamera camera;
    mjv_defaultCamera(&camera);
    stage_.Compose(&camera, show, nullptr);
  }

  Stage stage_{BallModel()};
};

TEST_F(StageTest, PutsTheRobotWhereTheStateHasIt) {
  stage_.Show(BallAt(3));
  EXPECT_EQ(stage_.InWorld(stage_.Body("ball"), {0, 0, 1})[0], 3);
  EXPECT_EQ(stage_.InBody(stage_.Body("ball"), {3, 0, 6})[2], 1);
}

TEST(StageOfSeveralTest, FollowsTheNamedRobotAndTreadsOnNoOther) {
  const std::string bytes = BinaryModel(
      "<mujoco><worldbody><geom type='plane' size='0 0 1'/>"
      "<body name='left/base' pos='0 0 1'><freejoint/><geom size='.1'/></body>"
      "<body name='right/base' pos='0 2 1'><freejoint/><geom size='.2'/></body>"
      "</worldbody></mujoco>");
  const auto stage_of = [&bytes](const std::string& robot) {
    return std::make_unique<Stage>(mjcf::ReadBinaryModel(bytes, "the test's"), robot);
  };
  const auto right = stage_of("right");
  EXPECT_NEAR(right->RobotBall().center[1], 2, 1e-6);
  EXPECT_EQ(right->Body("base"), right->Body("right/base"));
  EXPECT_FALSE(right->uneven());
  EXPECT_NEAR(stage_of("left")->RobotBall().center[1], 0, 1e-6);
}

TEST_F(StageTest, LeavesWhereItWasWhatIsNotFinite) {
  stage_.Show(BallAt(3));
  stage_.Show(BallAt(std::numeric_limits<double>::quiet_NaN()));
  EXPECT_EQ(stage_.data().qpos[0], 3);
}

TEST_F(StageTest, FindsTheRobotsBall) {
  stage_.Show(BallAt(3));
  // From -1 to 1 in x and y, from 4 to 7.1 in z: the arm, whose capsule ends beyond the ball.
  const Ball ball = stage_.RobotBall();
  EXPECT_NEAR(ball.center[0], 3, 1e-6);
  EXPECT_NEAR(ball.center[2], 5.55, 1e-6);
  EXPECT_NEAR(ball.radius, std::hypot(1, 1, 1.55), 1e-6);
}

TEST_F(StageTest, ShowsCollisionShapesInsteadWhenAsked) {
  stage_.Show(BallAt(0));
  Compose({});
  EXPECT_EQ(Count(mjGEOM_BOX), 0);
  Compose({.collision = true});
  EXPECT_EQ(Count(mjGEOM_BOX), 1);
}

TEST_F(StageTest, DrawsForcesContactsAndTheCrane) {
  SceneState state = BallAt(0);
  state.contacts = {{.at = {0, 0, 0}, .force = {0, 0, 1e5}}, {.at = {1, 0, 0}, .force = {0, 0, 0}}};
  state.crane = SceneState::Crane{.hook = {0, 0, 6}, .top = {0, 0, 8}, .tension = 10};
  stage_.Show(state);
  Compose({});
  EXPECT_EQ(Count(mjGEOM_ARROW), 0);
  EXPECT_EQ(Count(mjGEOM_CAPSULE), 2) << "the arm and the rope";
  Compose({.contacts = true, .forces = true});
  EXPECT_EQ(Count(mjGEOM_ARROW), 1) << "a force of nothing has no arrow";
  EXPECT_EQ(Count(mjGEOM_SPHERE), 1 + 2 + 2) << "the ball, hook and top, and two contacts";
}

TEST_F(StageTest, DrawsTheAxesOfJointsButNoCubeForTheFreeOne) {
  stage_.Show(BallAt(0));
  Compose({.joints = true});
  EXPECT_EQ(Count(mjGEOM_ARROW1), 1);
  EXPECT_EQ(Count(mjGEOM_BOX), 0);
}

TEST_F(StageTest, AlwaysDrawsAPush) {
  SceneState state = BallAt(0);
  state.pushes = {{.at = {0, 0, 5}, .force = {1e5, 0, 0}}};
  stage_.Show(state);
  Compose({});
  EXPECT_EQ(Count(mjGEOM_ARROW), 1);
}

TEST_F(StageTest, HasRoomForAsMuchAsItCanDraw) {
  SceneState state = BallAt(0);
  state.contacts.assign(10'000, {.at = {0, 0, 0}, .force = {0, 0, 1e5}});
  stage_.Show(state);
  Compose({.contacts = true, .forces = true});
  EXPECT_EQ(stage_.scene()->ngeom, stage_.scene()->maxgeom);
}

TEST_F(StageTest, NamesTheNearestBodyAndCamera) {
  EXPECT_THAT([&] { stage_.Body("bal"); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("'bal'"), HasSubstr("'ball'"))));
  EXPECT_THAT([&] { stage_.Camera("abov"); }, ThrowsMessage<ModelError>(HasSubstr("'above'")));
}

TEST_F(StageTest, RefusesWhatIsNoModel) {
  for (const std::string& bytes :
       {std::string(), std::string("no model"), std::string(50'000, 'x')}) {
    EXPECT_THAT([&] { mjcf::ReadBinaryModel(bytes, "run.mcap, model.mjb"); },
                ThrowsMessage<ModelError>(HasSubstr("run.mcap, model.mjb")));
    mjcf::TakeMujocoWarning();
  }
}

TEST_F(StageTest, RefusesHalfAModel) {
  const std::string whole = BinaryModel(kBallWorld);
  EXPECT_THROW(mjcf::ReadBinaryModel(std::string_view(whole).substr(0, whole.size() / 4), "x"),
               ModelError);
  mjcf::TakeMujocoWarning();
}

}  // namespace
}  // namespace understudy::viewer
