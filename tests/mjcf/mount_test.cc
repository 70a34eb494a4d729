#include "mjcf/mount.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

// An arm that ends in a fist, and a claw with a finger for it.
constexpr char kArm[] = R"(<mujoco>
  <worldbody>
    <body name="arm">
      <joint name="elbow"/>
      <geom size="0.1" mass="1"/>
      <body name="wrist" pos="0 0 0.5">
        <inertial mass="2" pos="0 0 0" diaginertia="1 1 1"/>
        <joint name="turn"/>
        <geom name="fist" size="0.1"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";
constexpr char kClaw[] = R"(<mujoco>
  <include file="common.xml"/>
  <worldbody>
    <body name="wrist">
      <inertial mass="3" pos="0 0 0" diaginertia="1 1 1"/>
      <body name="finger">
        <joint name="finger" class="claw"/>
        <geom size="0.1" mass="1"/>
      </body>
    </body>
  </worldbody>
</mujoco>)";
constexpr char kCommon[] = R"(<mujocoinclude>
  <default><default class="claw"><joint damping="7"/></default></default>
</mujocoinclude>)";

class MountTest : public test::MujocoTest {
 protected:
  MountTest() {
    folder_.Write("common.xml", kCommon);
    spec_.hands = {{.motors = {{.joint = "finger"}}}};
  }
  MjcfElement Read(const std::string& text) {
    return ReadMjcf(folder_.Write("part" + std::to_string(++count_) + ".xml", text));
  }

  test::TemporaryFolder folder_;
  robot::RobotSpec spec_;
  int count_ = 0;
};

TEST_F(MountTest, AWristKeepsPlaceAndJointsAndTakesAllElseFromItsHand) {
  MjcfElement root = Read(kArm);
  MountHands(spec_, {Read(kClaw)}, &root);
  const ModelHandle model = CompileMjcf(root);
  const int wrist = mj_name2id(model.get(), mjOBJ_BODY, "wrist");
  EXPECT_EQ(model->body_pos[3 * wrist + 2], 0.5);
  EXPECT_EQ(model->body_mass[wrist], 3);
  EXPECT_EQ(mj_name2id(model.get(), mjOBJ_GEOM, "fist"), -1);
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_JOINT, "turn"), 0);
  const int finger = mj_name2id(model.get(), mjOBJ_JOINT, "finger");
  ASSERT_GE(finger, 0);
  EXPECT_EQ(model->dof_damping[model->jnt_dofadr[finger]], 7);
}

TEST_F(MountTest, TakesWhatHandsIncludeFromOneFileOnce) {
  MjcfElement root = Read(R"(<mujoco><worldbody>
    <body name="wrist"><geom size="0.1"/></body><body name="other"><geom size="0.1"/></body>
    </worldbody></mujoco>)");
  std::string other = kClaw;
  for (const char* word : {"\"wrist\"", "\"finger\""}) {
    for (std::size_t at = 0; (at = other.find(word, at)) != std::string::npos;) {
      other.replace(at, std::string(word).size(),
                    std::string(word) == "\"wrist\"" ? "\"other\"" : "\"digit\"");
    }
  }
  MountHands(spec_, {Read(kClaw), Read(other)}, &root);
  EXPECT_GE(mj_name2id(CompileMjcf(root).get(), mjOBJ_JOINT, "digit"), 0);
}

// An arm whose geoms give no inertia, as those that are made of URDFs.
std::string ArmOfUrdf() {
  std::string arm = kArm;
  return arm.replace(0, 8, R"(<mujoco><compiler inertiafromgeom="false"/>)")
      .replace(arm.find("<geom size"), 10,
               R"(<inertial mass="1" pos="0 0 0" diaginertia="1 1 1"/><geom size)");
}

TEST_F(MountTest, AHandWithInertiaOfItsOwnFitsARobotWhoseGeomsGiveNone) {
  std::string claw = kClaw;
  claw.replace(claw.find("<geom size"), 10,
               R"(<inertial mass="4" pos="0 0 0" diaginertia="1 1 1"/><geom size)");
  MjcfElement root = Read(ArmOfUrdf());
  MountHands(spec_, {Read(claw)}, &root);
  const ModelHandle model = CompileMjcf(root);
  EXPECT_EQ(model->body_mass[mj_name2id(model.get(), mjOBJ_BODY, "finger")], 4);
}

TEST_F(MountTest, RefusesAHandThatNeedsTheInertiaOfItsGeomsForARobotWhoseGeomsGiveNone) {
  MjcfElement root = Read(ArmOfUrdf());
  EXPECT_THAT([&] { MountHands(spec_, {Read(kClaw)}, &root); },
              testing::ThrowsMessage<ModelError>(testing::HasSubstr("inertiafromgeom")));
}

TEST_F(MountTest, LeavesAModelAloneThatHasTheFingers) {
  spec_.hands[0].motors[0].joint = "elbow";
  MjcfElement root = Read(kArm);
  MountHands(spec_, {Read(kClaw)}, &root);
  EXPECT_GE(mj_name2id(CompileMjcf(root).get(), mjOBJ_GEOM, "fist"), 0);
}

TEST_F(MountTest, RefusesAHandWithoutItsWrist) {
  MjcfElement root = Read("<mujoco><worldbody/></mujoco>");
  try {
    MountHands(spec_, {Read(kClaw)}, &root);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("a hand for the body 'wrist', which"));
  }
}

}  // namespace
}  // namespace understudy::mjcf
