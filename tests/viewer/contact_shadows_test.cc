#include "viewer/contact_shadows.h"

#include <algorithm>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "viewer_test.h"

namespace understudy::viewer {
namespace {

// Shadows under a shoe of 0.2 m by 0.1 m, whose sole is at that height [m], on a plane.
class ContactShadowsTest : public test::MujocoTest {
 protected:
  std::vector<mjvGeom> ShadowsOf(double height, const std::string& more = "",
                                 const std::string& shoe = "<geom type='box' size='.1 .05 .02'/>") {
    const mjcf::ModelHandle model = mjcf::ReadBinaryModel(
        BinaryModel("<mujoco><worldbody><geom type='plane' size='0 0 1'/>" + more +
                    "<body name='shoe' pos='1 2 " + std::to_string(height + 0.02) +
                    "' euler='0 0 90'><freejoint/>" + shoe + "</body></worldbody></mujoco>"),
        "the test's");
    const mjcf::DataHandle data(mj_makeData(model.get()));
    mj_kinematics(model.get(), data.get());
    mjvScene scene;
    mjv_defaultScene(&scene);
    mjv_makeScene(model.get(), &scene, 100);
    AddContactShadows(
        *model, *data, [&](int geom) { return model->geom_bodyid[geom] > 0; }, &scene);
    std::vector<mjvGeom> shadows(scene.geoms, scene.geoms + scene.ngeom);
    mjv_freeScene(&scene);
    return shadows;
  }
};

TEST_F(ContactShadowsTest, LieOnTheGroundUnderWhatTreadsOnItTurnedAsThatIs) {
  const std::vector<mjvGeom> shadows = ShadowsOf(0);
  ASSERT_FALSE(shadows.empty());
  float long_side = 0;
  float short_side = 0;
  float height = 0;
  for (const mjvGeom& sheet : shadows) {
    EXPECT_EQ(sheet.type, mjGEOM_PLANE) << "others cast shadows themselves";
    EXPECT_NEAR(sheet.pos[0], 1, 1e-6);
    EXPECT_NEAR(sheet.pos[1], 2, 1e-6);
    EXPECT_GT(sheet.pos[2], height) << "in one plane they would flicker";
    height = sheet.pos[2];
    EXPECT_NEAR(sheet.mat[3], 1, 1e-6) << "its first side lies along the world's y";
    long_side = std::max(long_side, sheet.size[0]);
    short_side = std::max(short_side, sheet.size[1]);
  }
  EXPECT_LT(height, 0.01F);
  EXPECT_NEAR(long_side, 0.1 + 0.025, 0.025);  // half of the shoe, and somewhat more
  EXPECT_NEAR(short_side, 0.05 + 0.025, 0.025);
}

TEST_F(ContactShadowsTest, FadeAsItRises) {
  const std::vector<mjvGeom> low = ShadowsOf(0.01);
  const std::vector<mjvGeom> high = ShadowsOf(0.06);
  ASSERT_FALSE(low.empty());
  ASSERT_FALSE(high.empty());
  EXPECT_LT(high.back().rgba[3], low.back().rgba[3]);
  EXPECT_TRUE(ShadowsOf(0.09).empty());
}

TEST_F(ContactShadowsTest, LieOnABlockThatStandsBetween) {
  const auto shadows = ShadowsOf(0.3, "<geom type='box' pos='1 2 .15' size='.5 .5 .15'/>");
  ASSERT_FALSE(shadows.empty());
  EXPECT_NEAR(shadows.back().pos[2], 0.3, 0.01);
}

// It weighs, or else loading would leave it out.
TEST_F(ContactShadowsTest, AreNotCastByShapesThatTouchNothing) {
  const std::string shape = "<geom type='box' size='.1 .05 .02' contype='0' conaffinity='0'/>";
  EXPECT_TRUE(ShadowsOf(0, "", shape).empty());
}

TEST_F(ContactShadowsTest, DoNotFallOnRobots) {
  const std::string other =
      "<body pos='1 2 .1'><freejoint/><geom type='box' size='.3 .3 .1'/></body>";
  for (const mjvGeom& sheet : ShadowsOf(0.2, other)) EXPECT_LT(sheet.pos[2], 0.01F);
}

}  // namespace
}  // namespace understudy::viewer
