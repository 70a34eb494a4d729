#include "physics/joint_dynamics.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "config/load.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

using testing::AllOf;
using testing::Ge;
using testing::Le;

const std::filesystem::path kSource = UNDERSTUDY_SOURCE_DIR;

struct Joint {
  double armature, damping, frictionloss;

  friend bool operator==(const Joint&, const Joint&) = default;
};

Joint JointOf(const mjModel& model, const std::string& name) {
  const int dof = model.jnt_dofadr[mj_name2id(&model, mjOBJ_JOINT, name.c_str())];
  return {model.dof_armature[dof], model.dof_damping[dof], model.dof_frictionloss[dof]};
}

class JointDynamicsTest : public test::MujocoTest {
 protected:
  // The model of one of our robots, with the figures asked for or, for "", its own choice.
  static mjcf::ModelHandle Load(const std::string& robot, const std::string& use) {
    return LoadWith(
        {.robot = robot,
         .sets = use.empty() ? std::vector<std::string>{} : std::vector{"robot.dynamics=" + use}});
  }

  static mjcf::ModelHandle LoadWith(const config::Layers& layers) {
    const robot::RobotSpec spec = config::LoadConfig(layers, kSource).robots[0].spec;
    return LoadWorldModel({{spec, kSource / "models" / spec.model}},
                          kSource / "models/scene/flat.xml", 0.001);
  }
};

// docs/dev/sources.md#go2-fits: the friction of a real Go2's calf is 0.5 to 1.0 N·m, of hip and
// thigh 0.14 to 0.29; the 0.2 of the vendor's model is too small at the calf.
TEST_F(JointDynamicsTest, GivesTheGo2TheJointFrictionThatRealOnesShow) {
  const mjcf::ModelHandle model = Load("go2", "");
  for (const std::string leg : {"FR", "FL", "RR", "RL"}) {
    EXPECT_THAT(JointOf(*model, leg + "_calf_joint").frictionloss, AllOf(Ge(0.5), Le(1.0))) << leg;
    for (const std::string joint : {"_hip_joint", "_thigh_joint"}) {
      EXPECT_THAT(JointOf(*model, leg + joint).frictionloss, AllOf(Ge(0.14), Le(0.29)))
          << leg << joint;
    }
  }
}

TEST_F(JointDynamicsTest, LeavesAMotorTheArmatureThatIsItsOwn) {
  const mjcf::ModelHandle model =
      LoadWith({.robot = "go2", .sets = {"robot.motors.FR_calf_joint.armature=0.07"}});
  EXPECT_EQ(JointOf(*model, "FR_calf_joint"), (Joint{0.07, 0.34, 0.645}));
  EXPECT_EQ(JointOf(*model, "FL_calf_joint"), (Joint{0.043, 0.34, 0.645}));
}

TEST_F(JointDynamicsTest, LeavesTheModelItsOwnFiguresUnderCatalogue) {
  const mjcf::ModelHandle model = Load("go2", "catalogue");
  for (const std::string joint : {"FR_hip_joint", "FL_thigh_joint", "RL_calf_joint"}) {
    EXPECT_EQ(JointOf(*model, joint), (Joint{0.01, 0.1, 0.2})) << joint;
  }
}

TEST_F(JointDynamicsTest, LeavesJointsOfWhichTheFitSaysNothingAlone) {
  const mjcf::ModelHandle model = Load("go2w", "fitted");
  EXPECT_EQ(JointOf(*model, "FR_calf_joint"), (Joint{0.043, 0.34, 0.645}));
  EXPECT_EQ(JointOf(*model, "FR_wheel_joint"), (Joint{0.01, 0.1, 0.2}));
}

TEST_F(JointDynamicsTest, LeavesFiguresOfWhichTheFitSaysNothingAlone) {
  const mjcf::ModelHandle fitted = Load("g1", "fitted");  // the fit is of kd only
  const mjcf::ModelHandle catalogue = Load("g1", "catalogue");
  for (const std::string joint :
       {"left_ankle_pitch_joint", "waist_roll_joint", "left_knee_joint"}) {
    EXPECT_EQ(JointOf(*fitted, joint), JointOf(*catalogue, joint)) << joint;
  }
}

constexpr char kGround[] =
    R"(<mujoco><worldbody><geom type="plane" size="0 0 1"/></worldbody></mujoco>)";

std::string Robot(const std::string& joint) {
  return R"(<mujoco><worldbody><body name="pelvis"><freejoint/><geom size=".1"/><site name="imu"/>
            <body name="shin" pos="0 0 -.3"><joint )" +
         joint + R"(/><geom size=".1" pos=".1 0 -.2"/></body></body></worldbody></mujoco>)";
}

robot::RobotSpec Spec() {
  robot::RobotSpec spec;
  spec.base_body = spec.crane_body = "pelvis";
  spec.imu.site = "imu";
  spec.motors = {{.joint = "knee_joint", .slot = 5, .torque_limit = 1}};
  return spec;
}

robot::RobotSpec FittedSpec() {
  robot::RobotSpec spec = Spec();
  spec.dynamics.use = robot::DynamicsSource::kFitted;
  spec.dynamics.fitted = {{.slots = {5}, .armature = 0.3, .damping = 2, .frictionloss = 0.7}};
  return spec;
}

TEST_F(JointDynamicsTest, IsTheSameAsAFileWithTheseFigures) {
  const test::TemporaryFolder folder;
  const auto ground = folder.Write("ground.xml", kGround);
  const auto plain = folder.Write("plain.xml", Robot(R"(name="knee_joint")"));
  const auto written = folder.Write(
      "written.xml", Robot(R"(name="knee_joint" armature=".3" damping="2" frictionloss=".7")"));
  const mjcf::ModelHandle fitted = LoadWorldModel({{FittedSpec(), plain}}, ground, 0.001);
  const mjcf::ModelHandle model = LoadWorldModel({{Spec(), written}}, ground, 0.001);
  EXPECT_EQ(JointOf(*fitted, "knee_joint"), (Joint{0.3, 2, 0.7}));
  ASSERT_EQ(fitted->nv, model->nv);
  for (int dof = 0; dof < model->nv; ++dof) {  // what contacts and friction are scaled by
    EXPECT_EQ(fitted->dof_invweight0[dof], model->dof_invweight0[dof]) << dof;
    EXPECT_EQ(fitted->dof_M0[dof], model->dof_M0[dof]) << dof;
  }
}

TEST_F(JointDynamicsTest, GoesBySlotAndSoFindsAJointThatIsCalledOtherwise) {
  const test::TemporaryFolder folder;
  const auto ground = folder.Write("ground.xml", kGround);
  const auto other = folder.Write("other.xml", Robot(R"(name="knee" armature=".1")"));
  LoadNotes notes;
  const FittedModel fitted = LoadFittedModel({FittedSpec(), other}, ground, 0.001, &notes);
  EXPECT_EQ(JointOf(*fitted.model, "knee"), (Joint{0.3, 2, 0.7}));
}

}  // namespace
}  // namespace understudy::physics
