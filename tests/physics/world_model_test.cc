#include "physics/world_model.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "physics/mujoco_world.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

constexpr char kGround[] =
    R"(<mujoco><worldbody><geom type="plane" size="0 0 1"/></worldbody></mujoco>)";

// The smallest robot that loads: `joint` is the child's, `rest` stands beside the worldbody.
std::string Robot(const std::string& joint = R"(<joint name="knee_joint"/>)",
                  const std::string& rest = "") {
  return R"(<mujoco><worldbody><body name="pelvis"><freejoint/><geom name="sole" size=".1"/>
            <site name="imu"/><body name="shin">)" +
         joint + R"(<geom size=".1"/></body></body></worldbody>)" + rest + "</mujoco>";
}

class WorldModelTest : public test::MujocoTest {
 protected:
  WorldModelTest() {
    spec_.base_body = "pelvis";
    spec_.crane_body = "pelvis";
    spec_.imu.site = "imu";
    spec_.motors.resize(1);
    spec_.motors[0].joint = "knee_joint";
    spec_.feet = {{.name = "foot", .geoms = {"sole"}}};
  }

  void UseRobot(const std::string& text) { robot_ = folder_.Write("robot.xml", text); }
  void UseScene(const std::string& text) { scene_ = folder_.Write("ground.xml", text); }

  mjcf::ModelHandle Load() const { return LoadWorldModel({{spec_, robot_}}, scene_, 0.002); }

  FittedModel LoadFitted(LoadNotes* notes) const {
    return LoadFittedModel({spec_, robot_}, scene_, 0.002, notes);
  }

  // What the refusal says; "" when the model loads.
  std::string Refusal() const {
    try {
      Load();
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(), Not(HasSubstr("\n")));
      return error.what();
    }
    return "";
  }

  test::TemporaryFolder folder_;
  robot::RobotSpec spec_;
  std::filesystem::path robot_ = folder_.Write("robot.xml", Robot());
  std::filesystem::path scene_ = folder_.Write("ground.xml", kGround);
};

TEST_F(WorldModelTest, PutsTheRobotInTheScene) {
  const mjcf::ModelHandle model = Load();
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_BODY, "pelvis"), 0);
  EXPECT_EQ(model->ngeom, 3);
  EXPECT_EQ(model->opt.timestep, 0.002);
}

constexpr char kDecal[] =
    R"(<joint name="knee_joint"/><geom size=".2" mass="0" contype="0" conaffinity="0"/>)";

TEST_F(WorldModelTest, KeepsForTheEyeWhatIsOnlyLookedAt) {
  UseRobot(Robot(kDecal));
  const mjcf::ModelHandle world = Load();
  const mjcf::ModelHandle sight = LoadSightModel({{spec_, robot_}}, scene_, 0.002);
  EXPECT_EQ(sight->ngeom, 4);
  EXPECT_EQ(sight->nq, world->nq);
  EXPECT_EQ(sight->nbody, world->nbody);
}

// A look for the shin.
std::filesystem::path WriteLook(const test::TemporaryFolder& folder, const std::string& mesh,
                                const std::string& name = "shin.obj") {
  folder.Write(name, mesh);
  return folder.Write(
      "look.xml", R"(<mujoco><asset><mesh name="shin" file=")" + name + R"("/></asset><worldbody>
                         <body name="shin"><geom type="mesh" mesh="shin"/></body></worldbody></mujoco>)");
}
constexpr char kTetrahedron[] =
    "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";

TEST_F(WorldModelTest, GivesAnotherModelTheImuSiteThatItLacks) {
  std::string bare = Robot();
  bare.replace(bare.find(R"(<site name="imu"/>)"), 18, "");
  UseRobot(bare);
  LoadNotes notes;
  const FittedModel fitted = LoadFitted(&notes);
  EXPECT_GE(mj_name2id(fitted.model.get(), mjOBJ_SITE, "imu"), 0);
  EXPECT_THAT(notes.warnings, testing::Contains(HasSubstr("no IMU site")));
  EXPECT_EQ(LoadSightModel({{fitted.spec, robot_}}, scene_, 0.002)->nsite, 1);
  EXPECT_THAT(Refusal(), HasSubstr("no IMU site 'imu'")) << "of a robot's own file";
}

TEST_F(WorldModelTest, DrawsARobotByAnotherLookAndMovesItAsBefore) {
  UseRobot(Robot(kDecal));
  const std::string look = WriteLook(folder_, kTetrahedron);
  EXPECT_THAT(CheckLook({spec_, robot_}, look), HasSubstr("look.xml, 1 bodies"));
  const mjcf::ModelHandle plain = LoadSightModel({{spec_, robot_}}, scene_, 0.002);
  const mjcf::ModelHandle drawn = LoadSightModel({{spec_, robot_}}, scene_, 0.002, {look});
  EXPECT_EQ(drawn->nmesh, 1);
  ASSERT_EQ(drawn->nbody, plain->nbody);
  for (int i = 0; i < plain->nbody; ++i) EXPECT_EQ(drawn->body_mass[i], plain->body_mass[i]);
}

TEST_F(WorldModelTest, RefusesAtTheStartALookThatMujocoCannotReadAndThenShowsTheRobotsOwn) {
  UseRobot(Robot(kDecal));
  const std::string look = WriteLook(folder_, "solid", "shin.stl");
  EXPECT_THROW(CheckLook({spec_, robot_}, look), ModelError);
  EXPECT_EQ(LoadSightModel({{spec_, robot_}}, scene_, 0.002, {look})->ngeom, 4);
  mjcf::TakeMujocoWarning();
}

TEST_F(WorldModelTest, ShowsAWorldWhoseLooksAreMissingWithoutThem) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>
                    <geom type="mesh" mesh="shell" mass="0" contype="0" conaffinity="0"/>)",
                 R"(<asset><mesh name="shell" file="lost.stl"/></asset>)"));
#if mjVERSION_HEADER < 300
  EXPECT_EQ(LoadSightModel({{spec_, robot_}}, scene_, 0.002)->ngeom, 3);
#else
  EXPECT_THROW(LoadSightModel({{spec_, robot_}}, scene_, 0.002), ModelError);
#endif
}

#if mjVERSION_HEADER < 300
TEST_F(WorldModelTest, HasRoomForManyContactsWhateverTheFilesSay) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>)", R"(<size nconmax="20" njmax="50"/>)"));
  EXPECT_GE(Load()->nconmax, 150);
  EXPECT_GE(Load()->njmax, 600);
  UseRobot(Robot(R"(<joint name="knee_joint"/>)", R"(<size nconmax="900" njmax="3000"/>)"));
  EXPECT_EQ(Load()->nconmax, 900);
  EXPECT_EQ(Load()->njmax, 3000);
}
#endif

TEST_F(WorldModelTest, ComputesNoSensorOfTheModels) {
  UseRobot(
      Robot(R"(<joint name="knee_joint"/>)", R"(<sensor><jointpos joint="knee_joint"/></sensor>)"));
  const mjcf::ModelHandle model = Load();
  EXPECT_EQ(model->nsensor, 1);
  EXPECT_NE(model->opt.disableflags & mjDSBL_SENSOR, 0);
}

TEST_F(WorldModelTest, AddsAClampThatIsOff) {
  mjcf::ModelHandle model = Load();
  EXPECT_GE(mj_name2id(model.get(), mjOBJ_EQUALITY, kClampName), 0);
  EXPECT_FALSE(MujocoWorld(std::move(model), {{spec_}}).robot().clamped());
}

TEST_F(WorldModelTest, SwitchesTheModelsOwnActuatorsOff) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>)",
                 R"(<actuator><position joint="knee_joint" kp="100"/></actuator>)"));
  EXPECT_NE(Load()->opt.disableflags & mjDSBL_ACTUATION, 0);
}

TEST_F(WorldModelTest, LoadsFilesWhoseNamesNeedEscapes) {
  robot_ = folder_.Write("a & b < c/my \"robot\".xml", Robot());
  EXPECT_EQ(Refusal(), "");
}

TEST_F(WorldModelTest, FindsWhatTheRobotsFileNamesRelativeToItself) {
  folder_.Write("robot/parts/tetra.obj",
                "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
                "f 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n");
  folder_.Write("robot/shin.xml",
                R"(<mujoco><asset><mesh name="tetra" file="tetra.obj"/></asset></mujoco>)");
  robot_ = folder_.Write("robot/robot.xml",
                         Robot(R"(<joint name="knee_joint"/><geom type="mesh" mesh="tetra"/>)",
                               R"(<compiler meshdir="parts"/><include file="shin.xml"/>)"));
  EXPECT_EQ(Refusal(), "");
}

TEST_F(WorldModelTest, RefusesFilesThatAreNone) {
  const auto here = robot_;
  robot_ = folder_.path() / "nobody.xml";
  EXPECT_EQ(Refusal(), robot_.string() + ": no such file");
  robot_ = folder_.path();
  EXPECT_EQ(Refusal(), robot_.string() + ": is a folder");
  robot_ = here;
  scene_ = folder_.path() / "nowhere.xml";
  EXPECT_EQ(Refusal(), scene_.string() + ": no such file");
}

TEST_F(WorldModelTest, NamesTheRobotFileThatIsMalformed) {
  UseRobot("<mujoco><worldbody></mujoco>");
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("robot.xml:1: "), HasSubstr("XML")));
}

TEST_F(WorldModelTest, NamesTheSceneThatIsMalformed) {
  UseScene("<mujoco><worldbody></mujoco>");
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("ground.xml:1: "), Not(HasSubstr("robot.xml"))));
}

TEST_F(WorldModelTest, NamesTheElementThatMujocoDoesNotKnow) {
  UseRobot(Robot(R"(<hinge name="knee_joint"/>)"));
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("robot.xml:2: "), HasSubstr("hinge")));
}

TEST_F(WorldModelTest, NamesBothFilesWhenTheyDoNotGoTogether) {
  UseScene(
      R"(<mujoco><worldbody><body name="pelvis"><geom size="1"/></body></worldbody></mujoco>)");
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("robot.xml"), HasSubstr("ground.xml"), HasSubstr("pelvis")));
}

TEST_F(WorldModelTest, RefusesRungeKuttaOfTheRobot) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>)", R"(<option integrator="RK4"/>)"));
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("robot.xml"), HasSubstr("RK4"), HasSubstr("implicit")));
}

TEST_F(WorldModelTest, RefusesRungeKuttaOfTheSceneAndNamesIt) {
  UseScene(R"(<mujoco><option integrator="RK4"/></mujoco>)");
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("ground.xml"), HasSubstr("RK4")));
}

TEST_F(WorldModelTest, NamesWhatIsMissingItsKeyAndTheNearestThatIsThere) {
  using Spec = robot::RobotSpec;
  const std::pair<void (*)(Spec*), std::vector<const char*>> rows[] = {
      {[](Spec* spec) { spec->motors[0].joint = "kneee_joint"; },
       {"robot.xml", "joint 'kneee_joint'", "robot.motors.0.joint", "did you mean 'knee_joint'?"}},
      {[](Spec* spec) { spec->base_body = "pelwis"; }, {"base body 'pelwis'", "'pelvis'"}},
      {[](Spec* spec) { spec->imu.site = "imuu"; },
       {"site 'imuu'", "robot.imu.site", "did you mean 'imu'?"}},
      {[](Spec* spec) { spec->imu.secondary_site = "head_imu"; }, {"site 'head_imu'"}},
      {[](Spec* spec) { spec->feet[0].geoms = {"sohle"}; }, {"'sohle'", "did you mean 'sole'?"}},
      {[](Spec* spec) { spec->crane_body = "hook"; }, {"crane body 'hook'"}},
  };
  const Spec sound = spec_;
  for (const auto& [change, words] : rows) {
    spec_ = sound;
    change(&spec_);
    for (const char* word : words) EXPECT_THAT(Refusal(), HasSubstr(word));
  }
}

TEST_F(WorldModelTest, SaysOfAnotherRobotsModelThatItIsOneAndNotWhatItLacksFirst) {
  spec_.name = "go2";
  spec_.base_body = "base_link";
  EXPECT_THAT(Refusal(), HasSubstr("no base body 'base_link'")) << "it has the joint";
  spec_.motors[0].joint = "FR_hip_joint";
  EXPECT_THAT(Refusal(),
              AllOf(HasSubstr("robot.xml: no model of a 'go2'"), HasSubstr("any of its 1 motors"),
                    HasSubstr("own_robot.md"), Not(HasSubstr("robot.base_body"))));
  spec_.base_body = "pelvis";
  EXPECT_THAT(Refusal(), HasSubstr("no joint 'FR_hip_joint'")) << "it has the base";
}

TEST_F(WorldModelTest, TakesAnotherHandsNamesForWhatIsFittedAndSaysSo) {
  spec_.base_body = spec_.crane_body = "base_link";
  spec_.motors[0].joint = "knee";
  LoadNotes notes;
  FittedModel fitted = LoadFitted(&notes);
  EXPECT_EQ(fitted.spec.base_body, "pelvis");
  EXPECT_EQ(fitted.spec.crane_body, "pelvis");
  EXPECT_EQ(fitted.spec.motors[0].joint, "knee_joint");
  EXPECT_EQ(notes.warnings.size(), 2u);
  EXPECT_EQ(MujocoWorld(std::move(fitted.model), {{fitted.spec}}).robot().q().size(), 1u);
}

TEST_F(WorldModelTest, GoesWithoutFeetThatAreNotFoundAndSaysSo) {
  spec_.feet = {{.name = "left", .geoms = {"sole"}}, {.name = "right", .geoms = {"sohle"}}};
  LoadNotes notes;
  FittedModel fitted = LoadFitted(&notes);
  MujocoWorld world(std::move(fitted.model), {{fitted.spec}});
  ASSERT_EQ(notes.warnings.size(), 1u);
  EXPECT_THAT(notes.warnings[0],
              AllOf(HasSubstr("foot right"), HasSubstr("none"), HasSubstr("robot.feet.1.geoms")));
  std::vector<double> force(2);
  world.robot().FootForces(force);
}

TEST_F(WorldModelTest, LeavesTheSceneOutWhereTheRobotsFileHasGroundAndSaysSo) {
  UseRobot(R"(<mujoco><worldbody><geom name="floor" type="plane" size="0 0 1"/>)" +
           Robot().substr(sizeof("<mujoco><worldbody>") - 1));
  scene_ = folder_.path() / "nowhere.xml";
  LoadNotes notes;
  const FittedModel fitted = LoadFitted(&notes);
  EXPECT_EQ(fitted.model->ngeom, 3);
  ASSERT_EQ(notes.warnings.size(), 1u);
  EXPECT_THAT(notes.warnings[0], AllOf(HasSubstr("robot.xml"), HasSubstr("its own ground")));
}

TEST_F(WorldModelTest, TakesAPlaneThatNothingTouchesForNoGround) {
  UseRobot(R"(<mujoco><worldbody><geom type="plane" size="0 0 1" contype="0" conaffinity="0"/>)" +
           Robot().substr(sizeof("<mujoco><worldbody>") - 1));
  LoadNotes notes;
  const FittedModel fitted = LoadFitted(&notes);
  EXPECT_GE(fitted.model->ngeom, 3);
  EXPECT_TRUE(notes.warnings.empty());
}

#if mjVERSION_HEADER < 300
TEST_F(WorldModelTest, DoesWithoutAMissingMeshThatIsOnlyLookedAtAndSaysSo) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>
                    <geom type="mesh" mesh="shell" contype="0" conaffinity="0" mass="0"/>)",
                 R"(<asset><mesh name="shell" file="shell.obj"/></asset>)"));
  LoadNotes notes;
  EXPECT_EQ(LoadFitted(&notes).model->ngeom, 3);
  ASSERT_EQ(notes.warnings.size(), 1u);
  EXPECT_THAT(notes.warnings[0], AllOf(HasSubstr("robot.xml:3: <mesh> file: no file "),
                                       HasSubstr("shell.obj; visual mesh skipped")));
  ASSERT_EQ(notes.looks.size(), 1u);
  EXPECT_THAT(notes.looks[0], HasSubstr("1 geom, 1 mesh and 0 textures"));
}
#endif

TEST_F(WorldModelTest, RefusesAMissingMeshThatCollides) {
  UseRobot(Robot(R"(<joint name="knee_joint"/><geom type="mesh" mesh="shell"/>)",
                 R"(<asset><mesh name="shell" file="shell.obj"/></asset>)"));
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("robot.xml:2: <mesh> file: no file "),
                               testing::EndsWith("shell.obj")));
}

TEST_F(WorldModelTest, FindsMeshesOfRobotAndSceneInTheirOwnFolders) {
  const char* tetra = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
  folder_.Write("robot/parts/robot.obj", tetra);
  folder_.Write("scene/stones/scene.obj", tetra);
  robot_ = folder_.Write("robot/robot.xml",
                         Robot(R"(<joint name="knee_joint"/><geom type="mesh" mesh="robot"/>)",
                               R"(<compiler meshdir="parts"/>
                                  <asset><mesh file="robot.obj"/></asset>)"));
  scene_ = folder_.Write("scene/scene.xml", R"(<mujoco><compiler meshdir="stones"/>
      <asset><mesh file="scene.obj"/></asset>
      <worldbody><geom type="mesh" mesh="scene"/></worldbody></mujoco>)");
  EXPECT_EQ(Refusal(), "");
}

TEST_F(WorldModelTest, RefusesABaseThatIsNeitherFreeNorFixed) {
  spec_.base_body = "shin";
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("'shin'"), HasSubstr("<freejoint/>")));
}

TEST_F(WorldModelTest, RefusesABallJointAsAMotor) {
  UseRobot(Robot(R"(<joint name="knee_joint" type="ball"/>)"));
  EXPECT_THAT(Refusal(), AllOf(HasSubstr("'knee_joint'"), HasSubstr("hinge or a slide")));
}

TEST_F(WorldModelTest, RefusesTheFreeJointAsAMotor) {
  UseRobot(R"(<mujoco><worldbody><body name="pelvis"><joint name="knee_joint" type="free"/>
              <geom name="sole" size=".1"/><site name="imu"/></body></worldbody></mujoco>)");
  EXPECT_THAT(Refusal(), HasSubstr("hinge or a slide"));
}

TEST_F(WorldModelTest, TakesASlideAsAMotor) {
  UseRobot(Robot(R"(<joint name="knee_joint" type="slide"/>)"));
  EXPECT_EQ(Refusal(), "");
}

#if mjVERSION_HEADER < 300  // MuJoCo 3 computes no acceleration while it compiles
TEST_F(WorldModelTest, TellsWhatMujocoWarnsOfWhileItCompiles) {
  UseRobot(Robot(R"(<joint name="knee_joint"/>)", R"(<option gravity="0 0 -1e20"/>)"));
  LoadNotes notes;
  (void)LoadModelFile(robot_, &notes);
  ASSERT_EQ(notes.warnings.size(), 1u);
  EXPECT_THAT(notes.warnings[0], HasSubstr("robot.xml: "));
  EXPECT_EQ(mjcf::TakeMujocoWarning(), "");
}
#endif

}  // namespace
}  // namespace understudy::physics
