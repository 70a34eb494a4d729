#include "mjcf/look.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/compile.h"
#include "mjcf/looks.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::ThrowsMessage;

// A tetrahedron with edges of 1 m along the axes.
constexpr char kObj[] = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\nf 2 3 4\n";
constexpr char kRobot[] = R"(<mujoco><compiler angle="radian"/><worldbody>
  <body name="trunk"><freejoint/><inertial pos="0 0 0" mass="2" diaginertia="1 1 1"/>
    <geom name="hull" type="box" size=".1 .1 .1"/>
    <geom type="sphere" size=".2" contype="0" conaffinity="0"/>
    <body name="leg" pos="0 0 -1"><joint axis="0 1 0"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>
      <geom type="sphere" size=".3" contype="0" conaffinity="0"/></body>
  </body></worldbody></mujoco>)";

// A model of the vendor's with these elements in the trunk, and in the leg.
std::string Vendor(const std::string& trunk, const std::string& leg = "", double leg_z = -1) {
  return R"(<mujoco><compiler angle="radian" meshdir="meshes"/>
    <default><default class="seen"><geom contype="0" conaffinity="0" material="red"/></default></default>
    <asset><material name="red" rgba="1 0 0 1"/><mesh name="shell" file="shell.obj" scale="2 2 2"/>
      <mesh name="shin" file="shin.OBJ"/></asset>
    <worldbody><body name="trunk"><freejoint/>)" +
         trunk + "<body name='leg' pos='0 0 " + std::to_string(leg_z) + "'><joint axis='0 1 0'/>" +
         leg + "</body></body></worldbody></mujoco>";
}

class LookTest : public test::MujocoTest {
 protected:
  LookTest() {
    std::filesystem::create_directories(folder_.path() / "bot/meshes");
    folder_.Write("bot/meshes/shell.obj", kObj);
    folder_.Write("bot/meshes/shin.OBJ", kObj);
    robot_ = ReadMjcf(folder_.Write("robot.xml", kRobot));
  }
  Look Find(const std::string& vendor) {
    return FindLook(folder_.Write("bot/bot.xml", vendor), robot_);
  }
  ModelHandle Dressed(const Look& look) {
    MjcfElement tree = robot_;
    PutOn(look, &tree);
    return CompileMjcf(tree);
  }

  test::TemporaryFolder folder_;
  MjcfElement robot_;
};

constexpr char kShell[] = "<geom type='mesh' mesh='shell' class='seen'/>";
constexpr char kShin[] = "<geom type='mesh' mesh='shin' class='seen' rgba='0 0 1 1'/>";

TEST_F(LookTest, DrawsEachBodyByItsMeshesInTheirColours) {
  const ModelHandle model = Dressed(Find(Vendor(kShell, kShin)));
  ASSERT_EQ(model->ngeom, 3) << "the hull, shell and shin";
  EXPECT_EQ(model->nmesh, 2);
  EXPECT_EQ(model->geom_type[0], mjGEOM_BOX);
  EXPECT_EQ(model->geom_type[1], mjGEOM_MESH);
  EXPECT_EQ(model->geom_rgba[4], 1) << "the material's red";
  EXPECT_EQ(model->geom_rgba[5], 0);
  EXPECT_EQ(model->geom_rgba[8 + 2], 1) << "its own blue";
  EXPECT_NEAR(model->geom_rbound[1] / model->geom_rbound[2], 2, 1e-6) << "scaled";
}

TEST_F(LookTest, ChangesNothingThatCollidesOrWeighs) {
  const ModelHandle plain = CompileMjcf(robot_);
  const ModelHandle dressed = Dressed(Find(Vendor(kShell, kShin)));
  ASSERT_EQ(dressed->nbody, plain->nbody);
  for (int i = 0; i < plain->nbody; ++i) {
    EXPECT_EQ(dressed->body_mass[i], plain->body_mass[i]);
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(dressed->body_inertia[3 * i + k], plain->body_inertia[3 * i + k]);
      EXPECT_EQ(dressed->body_ipos[3 * i + k], plain->body_ipos[3 * i + k]);
    }
  }
  for (int i = 1; i < dressed->ngeom; ++i) {
    EXPECT_EQ(dressed->geom_contype[i], 0);
    EXPECT_EQ(dressed->geom_conaffinity[i], 0);
  }
  MjcfElement bare = robot_;
  PutOn(Find(Vendor(kShell, kShin)), &bare);
  EXPECT_EQ(LeaveOutLooks(&bare).geoms, 2) << "a run does not compile them";
}

TEST_F(LookTest, KeepsTheShapesOfBodiesWithoutMeshes) {
  const ModelHandle model = Dressed(Find(Vendor(kShell)));
  EXPECT_EQ(model->ngeom, 3);
  EXPECT_EQ(model->geom_type[2], mjGEOM_SPHERE);
}

TEST_F(LookTest, PrefersWhatIsSeenToWhatCollides) {
  const Look look = Find(Vendor(std::string(kShell) + "<geom type='mesh' mesh='shin'/>",
                                "<geom type='mesh' mesh='shin'/>"));
  ASSERT_EQ(look.bodies.size(), 2u);
  EXPECT_EQ(look.bodies[0].geoms.size(), 1u);
  EXPECT_EQ(look.bodies[1].geoms.size(), 1u) << "of a body that has no other";
}

TEST_F(LookTest, DrawsWhatHangsOnABodyWithItInItsPlace) {
  const Look look =
      Find(Vendor("<body name='logo' pos='0 0 .5' euler='0 0 1.5707963'>"
                  "<geom type='mesh' mesh='shell' class='seen' pos='.1 0 0'/></body>"));
  ASSERT_EQ(look.bodies.size(), 1u);
  EXPECT_EQ(look.bodies[0].body, "trunk");
  const MjcfElement& geom = look.bodies[0].geoms.front();
  double x = 0, y = 0, z = 0;
  ASSERT_EQ(std::sscanf(geom.Get("pos").c_str(), "%lf %lf %lf", &x, &y, &z), 3);
  EXPECT_NEAR(x, 0, 1e-6);
  EXPECT_NEAR(y, 0.1, 1e-6);
  EXPECT_NEAR(z, 0.5, 1e-6);
}

TEST_F(LookTest, KnowsABodyOfAnotherNameByItsJoint) {
  robot_.children.clear();
  robot_ = ReadMjcf(
      folder_.Write("named.xml",
                    "<mujoco><worldbody><body name='trunk'><body name='leg' pos='0 0 -1'>"
                    "<joint name='knee'/><geom size='1'/></body></body></worldbody></mujoco>"));
  const Look look = Find(
      "<mujoco><asset><mesh name='m' file='meshes/shell.obj'/></asset><worldbody>"
      "<body name='trunk'><body name='leg_with_foot' pos='0 0 -1'><joint name='knee'/>"
      "<geom type='mesh' mesh='m'/></body></body></worldbody></mujoco>");
  ASSERT_EQ(look.bodies.size(), 1u);
  EXPECT_EQ(look.bodies[0].body, "leg");
}

TEST_F(LookTest, ReadsUrdf) {
  const auto file = folder_.Write("bot/bot.urdf", R"(<robot name="bot">
    <link name="trunk"><visual><origin xyz="0 0 .2"/><geometry><mesh filename="meshes/shell.obj"/></geometry></visual>
    </link><link name="leg"/><joint name="knee" type="revolute"><parent link="trunk"/><child link="leg"/>
    <origin xyz="0 0 -1"/><axis xyz="0 1 0"/><limit lower="-1" upper="1" effort="1" velocity="1"/></joint></robot>)");
  const Look look = FindLook(file, robot_);
  ASSERT_EQ(look.bodies.size(), 1u);
  EXPECT_EQ(look.bodies[0].body, "trunk");
  EXPECT_EQ(Dressed(look)->nmesh, 1);
}

// Two tetrahedra of an edge of 1 m in an own file of COLLADA: red, and without a colour.
constexpr char kTwoColours[] =
    R"(<COLLADA><library_effects><effect id="e"><profile_COMMON><technique><phong><diffuse>
  <color>1 0 0 1</color></diffuse></phong></technique></profile_COMMON></effect></library_effects>
  <library_materials><material id="red"><instance_effect url="#e"/></material></library_materials>
  <library_geometries><geometry id="g"><mesh>
  <source id="p"><float_array>0 0 0 1 0 0 0 1 0 0 0 1</float_array>
    <technique_common><accessor stride="3"/></technique_common></source>
  <vertices id="v"><input semantic="POSITION" source="#p"/></vertices>
  <triangles material="m" count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
  <triangles count="4"><input semantic="VERTEX" source="#v" offset="0"/><p>0 2 1 0 1 3 0 3 2 1 2 3</p></triangles>
  </mesh></geometry></library_geometries>
  <library_visual_scenes><visual_scene id="s"><node><instance_geometry url="#g"><bind_material><technique_common>
  <instance_material symbol="m" target="#red"/></technique_common></bind_material></instance_geometry></node>
  </visual_scene></library_visual_scenes></COLLADA>)";
constexpr char kUrdfOfDae[] = R"(<robot name="bot"><link name="trunk"><visual><geometry>
  <mesh filename="meshes/shell.dae" scale="2 2 2"/></geometry><material name="b"><color rgba="0 0 1 1"/></material>
  </visual></link></robot>)";

TEST_F(LookTest, DrawsEachColourOfADaeByItself) {
  folder_.Write("bot/meshes/shell.dae", kTwoColours);
  const Look look = FindLook(folder_.Write("bot/bot.urdf", kUrdfOfDae), robot_);
  ASSERT_EQ(look.bodies.size(), 1u);
  const std::vector<MjcfElement>& geoms = look.bodies[0].geoms;
  ASSERT_EQ(geoms.size(), 2u);
  EXPECT_EQ(geoms[0].Get("rgba"), "1 0 0 1") << "the file's";
  EXPECT_EQ(geoms[1].Get("rgba"), "0 0 1 1") << "the URDF's, where the file has none";
  const ModelHandle model = Dressed(look);
  ASSERT_EQ(model->nmesh, 2);
  EXPECT_EQ(model->mesh_facenum[0], 4);
  EXPECT_GT(model->geom_rbound[1], 2) << "scaled; else it is 1.2";
}

TEST_F(LookTest, LeavesNoFileOfADaeBehind) {
  folder_.Write("bot/meshes/shell.dae", kTwoColours);
  std::filesystem::path file;
  {
    const Look look = FindLook(folder_.Write("bot/bot.urdf", kUrdfOfDae), robot_);
    file = look.meshes.at(0).Get("file");
    EXPECT_TRUE(std::filesystem::exists(file));
  }
  EXPECT_FALSE(std::filesystem::exists(file));
}

TEST_F(LookTest, NamesADaeThatCannotBeRead) {
  folder_.Write("bot/meshes/shell.dae", "<COLLADA/>");
  const auto file = folder_.Write("bot/bot.urdf", kUrdfOfDae);
  EXPECT_THAT(
      [&] { FindLook(file, robot_); },
      ThrowsMessage<ModelError>(AllOf(HasSubstr("shell.dae:1"), HasSubstr("visual_scene"))));
}

TEST_F(LookTest, TakesOfAFolderTheModelThatDrawsMostOfTheRobot) {
  folder_.Write("bot/a_part.xml", Vendor(kShell));
  const auto whole = folder_.Write("bot/b_whole.xml", Vendor(kShell, kShin));
  folder_.Write("bot/c_moved.xml", Vendor(kShell, kShin, -1.01));
  folder_.Write("bot/d_scene.xml", "<mujoco/>");
  EXPECT_EQ(FindLook(folder_.path() / "bot", robot_).file, whole);
  EXPECT_EQ(FindLook(folder_.path(), robot_).file, whole) << "in a folder below";
}

TEST_F(LookTest, TakesOfEqualModelsTheOneWithoutOtherHandsAndWithMostMeshes) {
  const std::string finger = "<body name='finger'><joint name='bend'/></body>";
  folder_.Write("bot/a_hand.xml", Vendor(kShell + finger, std::string(kShin) + kShin + kShin));
  folder_.Write("bot/b_less.xml", Vendor(kShell, kShin));
  const auto best = folder_.Write("bot/c_best.xml", Vendor(kShell, std::string(kShin) + kShin));
  EXPECT_EQ(FindLook(folder_.path(), robot_).file, best);
}

TEST_F(LookTest, RefusesAnotherRobotWithTheSameNames) {
  EXPECT_THAT([&] { Find(Vendor(kShell, kShin, -1.2)); },
              ThrowsMessage<ModelError>(
                  AllOf(HasSubstr("bot.xml"), HasSubstr("another robot"), HasSubstr("0.2 m"))));
}

TEST_F(LookTest, SaysWhatItLookedFor) {
  const auto fails = [&](const std::filesystem::path& place, const auto& words) {
    EXPECT_THAT([&] { FindLook(place, robot_); }, ThrowsMessage<ModelError>(words));
  };
  fails(folder_.path() / "nowhere",
        AllOf(HasSubstr("nowhere"), HasSubstr("no such file or folder")));
  fails(folder_.path() / "bot/meshes", HasSubstr(".urdf"));
  folder_.Write("bot/bot.xml", "<mujoco><worldbody><body name='wing'/></worldbody></mujoco>");
  fails(folder_.path() / "bot", HasSubstr("'leg'"));
  folder_.Write("bot/bot.xml", Vendor("<geom type='mesh' mesh='gone' class='seen'/>"));
  fails(folder_.path() / "bot", HasSubstr("has no mesh"));
}

TEST_F(LookTest, NamesTheMeshFileThatIsMissingOrOfAnotherKind) {
  std::filesystem::remove(folder_.path() / "bot/meshes/shell.obj");
  EXPECT_THAT([&] { Find(Vendor(kShell)); },
              ThrowsMessage<ModelError>(AllOf(HasSubstr("bot.xml:3"), HasSubstr("shell.obj"))));
}

TEST_F(LookTest, SurvivesFilesThatAreNoModels) {
  folder_.Write("bot/a.xml", "\"trunk\" <<<");
  folder_.Write("bot/b.urdf", "<robot name='\"trunk\"'/>");
  folder_.Write("bot/bot.xml", Vendor(kShell));
  EXPECT_EQ(FindLook(folder_.path(), robot_).bodies.size(), 1u);
}

}  // namespace
}  // namespace understudy::mjcf
