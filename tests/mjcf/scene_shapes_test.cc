#include "mjcf/scene_shapes.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "mjcf/compile.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;
using Kind = SceneShape::Kind;

class SceneShapesTest : public test::MujocoTest {
 protected:
  std::vector<SceneShape> Shapes(const std::string& world, const std::string& assets = "") {
    const ModelHandle model = CompileMjcf(ReadMjcf(
        folder_.Write("scene.xml", "<mujoco><compiler angle='radian'/><asset>" + assets +
                                       "</asset><worldbody>" + world + "</worldbody></mujoco>")));
    return SceneShapesOf(*model, "base");
  }

  test::TemporaryFolder folder_;
};

TEST_F(SceneShapesTest, HaveThePlaceAndTheWholeSizeOfTheirGeoms) {
  const auto shapes = Shapes(
      "<geom name='box' type='box' size='1 2 3' pos='4 5 6' rgba='0.1 0.2 0.3 0.4'/>"
      "<body pos='0 0 1'><geom type='sphere' size='0.5' pos='0 0 1'/>"
      "<geom type='ellipsoid' size='0.1 0.2 0.3'/><geom type='cylinder' size='0.1 2'/></body>");
  ASSERT_THAT(shapes, SizeIs(4));
  EXPECT_EQ(shapes[0].name, "box");
  EXPECT_EQ(shapes[0].kind, Kind::kBox);
  EXPECT_EQ(shapes[0].size, Vector3d(2, 4, 6));
  EXPECT_EQ(shapes[0].X_WS.translation(), Vector3d(4, 5, 6));
  EXPECT_THAT(shapes[0].rgba, ElementsAre(0.1F, 0.2F, 0.3F, 0.4F));
  EXPECT_EQ(shapes[1].kind, Kind::kEllipsoid);
  EXPECT_EQ(shapes[1].size, Vector3d(1, 1, 1));
  EXPECT_EQ(shapes[1].X_WS.translation(), Vector3d(0, 0, 2));
  EXPECT_EQ(shapes[2].size, Vector3d(0.2, 0.4, 0.6));
  EXPECT_EQ(shapes[3].kind, Kind::kCylinder);
  EXPECT_EQ(shapes[3].size, Vector3d(0.2, 0.2, 4));
}

TEST_F(SceneShapesTest, OfAPlaneAreABoxBelowIt) {
  const auto shapes = Shapes("<geom type='plane' size='0 3 1' pos='0 0 2' euler='0 1.5707963 0'/>");
  ASSERT_THAT(shapes, SizeIs(1));
  EXPECT_EQ(shapes[0].size.head<2>(), Eigen::Vector2d(2 * kEndlessPlane, 6));
  const Vector3d top = shapes[0].X_WS * Vector3d(0, 0, shapes[0].size[2] / 2);
  EXPECT_LT((top - Vector3d(0, 0, 2)).norm(), 1e-9);
}

TEST_F(SceneShapesTest, OfACapsuleAreThree) {
  const auto shapes = Shapes("<geom name='post' type='capsule' size='0.1 1' pos='0 0 5'/>");
  ASSERT_THAT(shapes, SizeIs(3));
  EXPECT_EQ(shapes[0].size, Vector3d(0.2, 0.2, 2));
  EXPECT_EQ(shapes[1].X_WS.translation(), Vector3d(0, 0, 4));
  EXPECT_EQ(shapes[2].X_WS.translation(), Vector3d(0, 0, 6));
  EXPECT_EQ(shapes[2].name, "post");
}

TEST_F(SceneShapesTest, LeaveOutTheRobotWhatMovesAndWhatIsNotSeen) {
  EXPECT_THAT(
      Shapes(
          "<body name='base'><geom type='sphere' size='1'/><body><geom type='sphere' size='1'/>"
          "</body></body><body><joint/><geom type='sphere' size='1'/></body>"
          "<geom type='sphere' size='1' group='3'/><geom type='sphere' size='1' rgba='1 1 1 0'/>"),
      IsEmpty());
}

TEST_F(SceneShapesTest, HaveTheMeanColorOfTheirTexture) {
  const auto shapes = Shapes("<geom type='plane' size='1 1 1' material='m'/>",
                             "<texture name='t' type='2d' builtin='checker' rgb1='0.2 0.4 0' "
                             "rgb2='0.4 0.8 1' width='64' height='64'/>"
                             "<material name='m' texture='t' rgba='0.5 1 1 1'/>");
  ASSERT_THAT(shapes, SizeIs(1));
  EXPECT_NEAR(shapes[0].rgba[0], 0.15, 0.01);
  EXPECT_NEAR(shapes[0].rgba[1], 0.6, 0.01);
  EXPECT_NEAR(shapes[0].rgba[2], 0.5, 0.01);
}

TEST_F(SceneShapesTest, OfAHeightFieldAreItsSquaresAndOfALargeOneEverySoMany) {
  for (const int side : {3, 400}) {
    const std::string count = std::to_string(side);
    const ModelHandle model = CompileMjcf(ReadMjcf(folder_.Write(
        "scene.xml", "<mujoco><asset><hfield name='h' nrow='" + count + "' ncol='" + count +
                         "' size='2 1 0.5 0.1'/></asset><worldbody><geom type='hfield' "
                         "hfield='h' pos='0 0 1'/></worldbody></mujoco>")));
    for (int i = 0; i < side * side; ++i) {  // rises along x
      model->hfield_data[i] = static_cast<float>(i % side) / static_cast<float>(side - 1);
    }
    const auto shapes = SceneShapesOf(*model, "");
    ASSERT_THAT(shapes, SizeIs(1));
    EXPECT_EQ(shapes[0].kind, Kind::kTriangles);
    const std::vector<Vector3d>& corners = shapes[0].corners;
    if (side == 3) {
      EXPECT_THAT(corners, SizeIs(4 * 6));
    } else {
      EXPECT_LE(corners.size(), 6U * kMostSquares);
      EXPECT_GT(corners.size(), 6U * kMostSquares / 4);
    }
    Eigen::AlignedBox3d box;
    for (std::size_t i = 0; i < corners.size(); i += 3) {
      for (std::size_t k = 0; k < 3; ++k) {
        box.extend(corners[i + k]);
        EXPECT_NEAR(corners[i + k][2], 0.25 * (corners[i + k][0] / 2 + 1), 1e-6);
      }
      const Vector3d up = (corners[i + 1] - corners[i]).cross(corners[i + 2] - corners[i]);
      ASSERT_GT(up[2], 0);
    }
    EXPECT_TRUE(box.min().isApprox(Vector3d(-2, -1, 0)));
    EXPECT_TRUE(box.max().isApprox(Vector3d(2, 1, 0.5)));
  }
}

TEST_F(SceneShapesTest, OfAMeshAreItsFaces) {
  const auto shapes = Shapes("<geom type='mesh' mesh='wedge'/>",
                             "<mesh name='wedge' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/>");
  ASSERT_THAT(shapes, SizeIs(1));
  EXPECT_THAT(shapes[0].corners, SizeIs(12));
  Eigen::AlignedBox3d box;
  for (const Vector3d& corner : shapes[0].corners) box.extend(shapes[0].X_WS * corner);
  EXPECT_TRUE(box.max().isApprox(Vector3d(1, 1, 1), 1e-6));
}

}  // namespace
}  // namespace understudy::mjcf
