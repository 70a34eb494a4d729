#include "mjcf/revise.h"

#include <numbers>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// A leg whose thigh has an <inertial> and whose shin has not, with a motor, a sensor of each kind
// and a tendon that refer to its joints.
constexpr char kLeg[] = R"(<mujoco>
  <default><joint armature="0.5"/></default>
  <worldbody>
    <body name="thigh" pos="0 0 1">
      <inertial mass="2" pos="0 0 -0.1" quat="0 1 0 0" diaginertia="0.2 0.2 0.1"/>
      <joint name="hip" axis="0 1 0"/>
      <site name="imu" pos="0.1 0 0"/>
      <body name="shin" pos="0 0 -0.3">
        <joint name="knee" axis="0 1 0"/>
        <geom size="0.1" mass="1"/>
      </body>
    </body>
  </worldbody>
  <tendon><fixed name="rope"><joint joint="hip" coef="1"/><joint joint="knee" coef="1"/></fixed></tendon>
  <actuator><motor name="knee_motor" joint="knee"/><motor name="hip_motor" joint="hip"/></actuator>
  <sensor>
    <jointpos name="knee_pos" joint="knee"/>
    <actuatorfrc name="knee_frc" actuator="knee_motor"/>
    <jointpos name="hip_pos" joint="hip"/>
  </sensor>
</mujoco>)";

class ReviseTest : public test::MujocoTest {
 protected:
  ModelHandle Revised(const std::string& text = kLeg) {
    MjcfElement root = ReadMjcf(folder_.Write("leg.xml", text));
    Revise(spec_, &root);
    return CompileMjcf(root);
  }
  std::string Refusal() {
    try {
      Revised();
    } catch (const ModelError& error) {
      return error.what();
    }
    return "";
  }
  // A camera that looks along y of the shin, so that its left is against the shin's x.
  static robot::CameraSpec OnShin(const char* name) {
    robot::CameraSpec camera;
    camera.name = name;
    camera.body = "shin";
    camera.pos = {0.1, 0.2, 0.3};
    camera.rpy = {0, 0, std::numbers::pi / 2};
    return camera;
  }
  // The second time in place of the first.
  ModelHandle AddedTwice(const robot::CameraSpec& camera) {
    spec_.cameras = {camera};
    MjcfElement root = ReadMjcf(folder_.Write("leg.xml", kLeg));
    AddCameras(spec_, &root);
    AddCameras(spec_, &root);
    return CompileMjcf(root);
  }
  static std::vector<double> Three(const mjtNum* x) { return {x[0], x[1], x[2]}; }

  test::TemporaryFolder folder_;
  robot::RobotSpec spec_;
};

TEST_F(ReviseTest, LeavesTheFileAsItIsWhereNothingIsSaid) {
  const ModelHandle model = Revised();
  EXPECT_EQ(model->body_mass[1], 2);
  EXPECT_EQ(model->njnt, 2);
  EXPECT_EQ(model->nsensor, 3);
  EXPECT_EQ(model->dof_armature[0], 0.5);
}

TEST_F(ReviseTest, GivesABodyItsPlaceAndKeepsItsMass) {
  spec_.bodies = {{.name = "shin", .pos = {0, 0.1, -0.4}}};
  const ModelHandle model = Revised();
  EXPECT_THAT(Three(model->body_pos + 6), ElementsAre(0, 0.1, -0.4));
  EXPECT_EQ(model->body_mass[2], 1);
}

TEST_F(ReviseTest, GivesABodyItsMassAndKeepsItsInertia) {
  spec_.bodies = {{.name = "thigh", .mass = 3}};
  const ModelHandle model = Revised();
  EXPECT_EQ(model->body_mass[1], 3);
  EXPECT_THAT(Three(model->body_ipos + 3), ElementsAre(0, 0, -0.1));
  EXPECT_THAT(Three(model->body_inertia + 3), ElementsAre(0.2, 0.2, 0.1));
}

// The orientation of the file's own <inertial> goes with its inertia: the new one is in the body's
// frame.
TEST_F(ReviseTest, GivesABodyItsCentreAndItsInertiaInItsOwnFrame) {
  spec_.bodies = {{.name = "thigh", .com = {0.1, 0, 0}, .inertia = {0.3, 0.2, 0.1, 0, 0, 0}}};
  const ModelHandle model = Revised();
  EXPECT_EQ(model->body_mass[1], 2);
  EXPECT_THAT(Three(model->body_ipos + 3), ElementsAre(0.1, 0, 0));
  EXPECT_THAT(Three(model->body_inertia + 3),
              testing::Pointwise(testing::DoubleNear(1e-12), {0.3, 0.2, 0.1}));
  EXPECT_NEAR(std::abs(model->body_iquat[4]), 1, 1e-9);
}

TEST_F(ReviseTest, GivesABodyWithoutInertialAllOfIt) {
  spec_.bodies = {
      {.name = "shin", .mass = 4, .com = {0, 0, 0}, .inertia = {0.3, 0.2, 0.15, 0, 0, 0}}};
  EXPECT_EQ(Revised()->body_mass[2], 4);
}

TEST_F(ReviseTest, RefusesPartOfIt) {
  spec_.bodies = {{.name = "shin", .mass = 4}};
  EXPECT_THAT(Refusal(), HasSubstr("leg.xml:8: robot.bodies.0: the file leaves mass and inertia of "
                                   "'shin' to its geoms; expected all of mass, com and inertia"));
}

TEST_F(ReviseTest, RefusesABodyOrSiteThatIsNotThere) {
  spec_.bodies = {{.name = "shinn", .mass = 4}};
  EXPECT_THAT(Refusal(), HasSubstr("no body 'shinn'; did you mean 'shin'? (robot.bodies.0.name "
                                   "names it)"));
  spec_.bodies = {};
  spec_.sites = {{.name = "imuu"}};
  EXPECT_THAT(Refusal(), HasSubstr("no site 'imuu'; did you mean 'imu'? (robot.sites.0.name"));
}

TEST_F(ReviseTest, MovesASite) {
  spec_.sites = {{.name = "imu", .pos = {0, 0, 0.2}}};
  EXPECT_THAT(Three(Revised()->site_pos), ElementsAre(0, 0, 0.2));
}

TEST_F(ReviseTest, AddsTheImuSiteThatAModelLacksToTheBase) {
  spec_.base_body = "shin";
  spec_.imu.site = "unit";
  spec_.sites = {{.name = "unit", .pos = {0, 0, 0.2}}};
  const ModelHandle model = Revised();
  const int site = mj_name2id(model.get(), mjOBJ_SITE, "unit");
  ASSERT_GE(site, 0);
  EXPECT_EQ(model->site_bodyid[site], mj_name2id(model.get(), mjOBJ_BODY, "shin"));
  EXPECT_THAT(Three(model->site_pos + 3 * static_cast<std::ptrdiff_t>(site)),
              ElementsAre(0, 0, 0.2));
}

TEST_F(ReviseTest, GivesAMotorsJointItsArmature) {
  robot::MotorSpec motor;
  motor.joint = "knee";
  motor.armature = 0.02;
  spec_.motors = {motor};
  motor.joint = "hip";
  spec_.hands = {{.motors = {motor}}};
  const ModelHandle model = Revised();
  EXPECT_EQ(model->dof_armature[0], 0.02);
  EXPECT_EQ(model->dof_armature[1], 0.02);
}

TEST_F(ReviseTest, LocksAJointAndLeavesOutWhatReadsOrDrivesIt) {
  spec_.locked_joints = {"knee"};
  const ModelHandle model = Revised();
  EXPECT_EQ(model->njnt, 1);
  EXPECT_EQ(model->nbody, 3);
  EXPECT_EQ(model->nu, 1);
  EXPECT_EQ(model->nsensor, 1);
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_SENSOR, "hip_pos"), 0);
  EXPECT_EQ(model->nwrap, 1);
}

TEST_F(ReviseTest, TakesAJointThatTheModelLacksForLocked) {
  spec_.locked_joints = {"ankle"};
  EXPECT_EQ(Revised()->njnt, 2);
}

TEST_F(ReviseTest, AddsCamerasThatLookAlongTheirXAndSeeAsMuchAsTheirLens) {
  robot::CameraSpec camera = OnShin("front");
  camera.focal = {360, 360};
  camera.centre = {639.5, 359.5};
  const ModelHandle model = AddedTwice(camera);
  ASSERT_EQ(model->ncam, 1);
  EXPECT_STREQ(mj_id2name(model.get(), mjOBJ_CAMERA, 0), "front");
  EXPECT_EQ(model->cam_bodyid[0], mj_name2id(model.get(), mjOBJ_BODY, "shin"));
  EXPECT_THAT(Three(model->cam_pos), ElementsAre(0.1, 0.2, 0.3));
  EXPECT_NEAR(model->cam_fovy[0], 90, 1e-6);
  mjtNum R[9];
  mju_quat2Mat(R, model->cam_quat);  // MuJoCo's look along -z
  EXPECT_NEAR(-R[5], 1, 1e-9) << "along y of the body";
  EXPECT_NEAR(R[7], 1, 1e-9) << "its up is the body's";
}

TEST_F(ReviseTest, AddsTheEyesOfACameraHalfItsBaselineToEachSide) {
  robot::CameraSpec camera = OnShin("head");
  camera.baseline = 0.06;
  const ModelHandle model = AddedTwice(camera);
  ASSERT_EQ(model->ncam, 2);
  const int left = mj_name2id(model.get(), mjOBJ_CAMERA, "head");
  const int right = mj_name2id(model.get(), mjOBJ_CAMERA, "head_right");
  ASSERT_TRUE(left >= 0 && right >= 0);
  EXPECT_NEAR(model->cam_pos[3 * left], 0.07, 1e-9);
  EXPECT_NEAR(model->cam_pos[3 * right], 0.13, 1e-9);
  EXPECT_NEAR(model->cam_pos[3 * right + 1], 0.2, 1e-9);
}

}  // namespace
}  // namespace understudy::mjcf
