#include "mjcf/urdf.h"

#include <random>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "config/load.h"
#include "config/model_files.h"
#include "config/robot_file.h"
#include "mjcf/compile.h"
#include "mjcf/eigen_views.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::HasSubstr;

class UrdfTest : public test::MujocoTest {
 protected:
  // MuJoCo's own reading of a URDF, which fixes the first link to the world.
  ModelHandle Read(Urdf urdf) {
    const std::size_t robot = urdf.text.find("<robot");
    urdf.text.insert(
        urdf.text.find('>', robot) + 1,
        R"(<mujoco><compiler fusestatic="false" strippath="false" boundmass="1e-8" boundinertia="1e-8"/></mujoco>)");
    for (const UrdfMesh& mesh : urdf.meshes) {
      std::filesystem::create_directories(folder_.path() / "meshes");
      folder_.Write("meshes/" + mesh.name + ".stl", mesh.stl);
    }
    std::array<char, 1000> error{};
    ModelHandle model(mj_loadXML(folder_.Write("robot.urdf", urdf.text).c_str(), nullptr,
                                 error.data(), static_cast<int>(error.size())));
    if (model == nullptr) throw ModelError(error.data() + urdf.text);
    return model;
  }
  ModelHandle Compile(const std::string& body, const std::string& rest = "") {
    return CompileMjcf(ReadMjcf(folder_.Write(
        "robot.xml", "<mujoco><compiler angle='radian'/>" + rest + "<worldbody><body name='base'>" +
                         body + "</body></worldbody></mujoco>")));
  }
  // About the centre of mass, in world axes.
  static Eigen::Matrix3d Inertia(const mjModel& model, const mjData& data, int body) {
    const RotationView axes(data.ximat + 9 * body);
    return axes * Vector(model.body_inertia + 3 * body).asDiagonal() * axes.transpose();
  }
  // Moves the joints alike and expects the bodies below `base` at the same places, as heavy.
  static void ExpectMovesAlike(const mjModel& ours, const std::string& base, const mjModel& read) {
    const DataHandle a = MakeDataWithoutContacts(ours), b = MakeDataWithoutContacts(read);
    std::mt19937 draw(7);
    int moved = 0;
    for (int joint = 0; joint < read.njnt; ++joint) {
      const char* const name = mj_id2name(&read, mjOBJ_JOINT, joint);
      const int mine = mj_name2id(&ours, mjOBJ_JOINT, name);
      ASSERT_GE(mine, 0) << name;
      const double angle = std::uniform_real_distribution<double>(-1, 1)(draw);
      a->qpos[ours.jnt_qposadr[mine]] = angle;
      b->qpos[read.jnt_qposadr[joint]] = angle;
      EXPECT_EQ(ours.jnt_limited[mine], read.jnt_limited[joint]) << name;
      for (int end = 0; end < 2 && ours.jnt_limited[mine] != 0; ++end) {
        EXPECT_NEAR(ours.jnt_range[2 * mine + end], read.jnt_range[2 * joint + end], 1e-6) << name;
      }
      const int dof = ours.jnt_dofadr[mine], other = read.jnt_dofadr[joint];
      EXPECT_NEAR(ours.dof_damping[dof], read.dof_damping[other], 1e-6) << name;
      EXPECT_NEAR(ours.dof_frictionloss[dof], read.dof_frictionloss[other], 1e-6) << name;
      ++moved;
    }
    int free = 0;
    for (int joint = 0; joint < ours.njnt; ++joint) free += ours.jnt_type[joint] == mjJNT_FREE;
    EXPECT_EQ(moved, ours.njnt - free);
    mj_kinematics(&ours, a.get());
    mj_kinematics(&read, b.get());
    const int root = mj_name2id(&ours, mjOBJ_BODY, base.c_str());
    const Eigen::Isometry3d to_base =
        (Eigen::Translation3d(Vector(a->xpos + 3 * root)) * Quaternion(a->xquat + 4 * root))
            .inverse();
    int below = 0;
    for (int body = root + 1; body < ours.nbody; ++body) {
      const char* const name = mj_id2name(&ours, mjOBJ_BODY, body);
      const int same = mj_name2id(&read, mjOBJ_BODY, name);
      ASSERT_GE(same, 0) << name;
      EXPECT_LT((to_base * Vector(a->xpos + 3 * body) - Vector(b->xpos + 3 * same)).norm(), 1e-6)
          << name;
      ++below;
      // To a link without mass MuJoCo gives that of what collides.
      if (ours.body_mass[body] == 0) continue;
      EXPECT_LT((to_base * Vector(a->xipos + 3 * body) - Vector(b->xipos + 3 * same)).norm(), 1e-6)
          << name;
      EXPECT_NEAR(ours.body_mass[body], read.body_mass[same], 1e-6) << name;
      const Eigen::Matrix3d turn = to_base.linear();
      EXPECT_LT(
          (turn * Inertia(ours, *a, body) * turn.transpose() - Inertia(read, *b, same)).norm(),
          1e-6)
          << name;
    }
    EXPECT_GT(below, 0);
  }

  test::TemporaryFolder folder_;
};

class UrdfOfRobotTest : public UrdfTest, public testing::WithParamInterface<std::string> {};

TEST_P(UrdfOfRobotTest, MovesAndWeighsAsTheModelDoes) {
  const config::Config config = config::LoadConfig({.robot = GetParam()}, UNDERSTUDY_SOURCE_DIR);
  const ModelHandle model = physics::LoadSightModel(
      {{config.robots[0].spec,
        UNDERSTUDY_SOURCE_DIR + std::string("/models/") + config.robots[0].spec.model,
        config::HandModelFiles(config.robots[0].spec)}},
      std::filesystem::path(UNDERSTUDY_SOURCE_DIR "/models/scene/flat.xml"), 0.001);
  const Urdf urdf =
      UrdfOf(*model, config.robots[0].spec.name, TreeOf(*model, config.robots[0].spec.base_body));
  ExpectMovesAlike(*model, config.robots[0].spec.base_body, *Read(urdf));
  EXPECT_THAT(urdf.text, HasSubstr("<visual>"));
}

INSTANTIATE_TEST_SUITE_P(Robots, UrdfOfRobotTest,
                         testing::ValuesIn(config::RobotNames(UNDERSTUDY_SOURCE_DIR)),
                         [](const auto& one) { return one.param; });

constexpr char kMass[] = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";

TEST_F(UrdfTest, PutsJointsThatAreNotAtTheOriginOfTheirBodyWhereTheyAre) {
  const ModelHandle model =
      Compile(std::string(kMass) +
              "<body name='arm' pos='0.1 0.2 0.3' euler='0.4 0.5 0.6'>"
              "<joint name='roll' axis='1 0 0' pos='0 0.1 0' damping='0.5'/>"
              "<joint name='pitch' axis='0 1 0' pos='0.1 0 0.2' limited='true' range='-1 2'/>"
              "<inertial pos='0.1 0 0' mass='2' diaginertia='1 2 2.5' euler='0.3 0 0.2'/>"
              "<body name='hand' pos='1 0 0' euler='0 1.5707963267948966 0'>"
              "<joint name='slide' type='slide' axis='0 0 1' limited='true' range='-0.1 0.2'/>" +
              kMass + "</body><body name='horn' pos='0 0 1'>" + kMass + "</body></body>");
  const Urdf urdf = UrdfOf(*model, "one", TreeOf(*model, "base"));
  ExpectMovesAlike(*model, "base", *Read(urdf));
  EXPECT_THAT(urdf.text, HasSubstr("roll_place"));
}

TEST_F(UrdfTest, TellsWhatADriveCanDo) {
  const ModelHandle model =
      Compile(std::string(kMass) + "<body name='arm'><joint name='roll'/>" + kMass + "</body>");
  EXPECT_THAT(
      UrdfOf(*model, "one", TreeOf(*model, "base"), {{"roll", {.effort = 23.5, .velocity = 30}}})
          .text,
      HasSubstr(R"(effort="23.5" velocity="30")"));
}

TEST_F(UrdfTest, WritesACapsuleAsACylinderBetweenTwoSpheres) {
  const ModelHandle model =
      Compile(std::string(kMass) +
              "<geom type='capsule' size='0.1 0.3' pos='0 0 1' contype='0' conaffinity='0'/>");
  const std::string text = UrdfOf(*model, "one", TreeOf(*model, "base")).text;
  EXPECT_THAT(text, HasSubstr(R"(<cylinder radius="0.1" length="0.6"/>)"));
  EXPECT_THAT(text, HasSubstr(R"(xyz="0 0 0.7")"));
  EXPECT_THAT(text, HasSubstr(R"(xyz="0 0 1.3")"));
  EXPECT_THAT(text, testing::Not(HasSubstr("<collision>")));
}

TEST_F(UrdfTest, WritesMeshesAsFilesBesideIt) {
  const ModelHandle model =
      Compile(std::string(kMass) + "<geom type='mesh' mesh='wedge' pos='0 0 0.5'/>",
              "<asset><mesh name='wedge' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset>");
  const Urdf urdf = UrdfOf(*model, "one", TreeOf(*model, "base"));
  ASSERT_EQ(urdf.meshes.size(), 1U);
  EXPECT_EQ(urdf.meshes[0].name, "wedge");
  EXPECT_EQ(urdf.meshes[0].stl.size(), 84U + 4 * 50);
  EXPECT_THAT(urdf.text, HasSubstr("filename=\"meshes/wedge.stl\""));
  const ModelHandle read = Read(urdf);
  ASSERT_EQ(read->nmesh, 1);
  EXPECT_EQ(read->mesh_facenum[0], 4);
}

TEST_F(UrdfTest, WritesMeshesAsTheBoxesAroundThemWhereThereAreNoFiles) {
  const ModelHandle model =
      Compile(std::string(kMass) + "<geom type='mesh' mesh='wedge' pos='0 0 0.5'/>",
              "<asset><mesh name='wedge' vertex='0 0 0 1 0 0 0 2 0 0 0 3'/></asset>");
  const Urdf urdf = UrdfOf(*model, "one", TreeOf(*model, "base"), {}, MeshUse::kPrimitives);
  EXPECT_TRUE(urdf.meshes.empty());
  const ModelHandle read = Read(urdf);
  ASSERT_EQ(read->nmesh, 0);
  ASSERT_GT(read->ngeom, 0);
  const DataHandle data = MakeDataWithoutContacts(*read);
  mj_kinematics(read.get(), data.get());
  const RotationView turn(data->geom_xmat);
  const Eigen::Vector3d middle = Vector(data->geom_xpos);
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0.5), Eigen::Vector3d(1, 0, 0.5),
                                        Eigen::Vector3d(0, 2, 0.5), Eigen::Vector3d(0, 0, 3.5)}) {
    const Eigen::Vector3d beyond =
        (turn.transpose() * (corner - middle)).cwiseAbs() - Vector(read->geom_size);
    EXPECT_LT(beyond.maxCoeff(), 1e-6) << corner.transpose();
  }
}

TEST_F(UrdfTest, WritesALongRoundMeshAsACylinderWhereThereAreNoFiles) {
  const ModelHandle model = Compile(
      std::string(kMass) + "<geom type='mesh' mesh='limb' pos='0 0 0.5'/>",
      "<asset><mesh name='limb' vertex='-1 .2 0 -1 -.2 0 -1 0 .24 -1 0 -.24 1 .2 0 1 -.2 0 1 0 .24 "
      "1 0 -.24'/></asset>");
  const Urdf urdf = UrdfOf(*model, "one", TreeOf(*model, "base"), {}, MeshUse::kPrimitives);
  const ModelHandle read = Read(urdf);
  const DataHandle data = MakeDataWithoutContacts(*read);
  mj_kinematics(read.get(), data.get());
  ASSERT_EQ(read->geom_type[0], mjGEOM_CYLINDER);
  EXPECT_NEAR(read->geom_size[0], 0.22, 1e-3);
  EXPECT_NEAR(read->geom_size[1], 1, 1e-3);
  EXPECT_NEAR(std::abs(data->geom_xmat[2]), 1, 1e-6);  // its axis is the mesh's long one, x
  EXPECT_NEAR(data->geom_xpos[2], 0.5, 1e-6);
}

TEST_F(UrdfTest, RefusesWhatUrdfHasNot) {
  const ModelHandle ball = Compile(
      std::string(kMass) + "<body name='arm'><joint name='b' type='ball'/>" + kMass + "</body>");
  const ModelHandle unnamed =
      Compile(std::string(kMass) + "<body><joint name='j'/>" + kMass + "</body>");
  for (const auto& [model, why] :
       {std::pair(ball.get(), "'b'"), std::pair(unnamed.get(), "no name")}) {
    try {
      UrdfOf(*model, "one", TreeOf(*model, "base"));
      ADD_FAILURE() << why;
    } catch (const ModelError& error) {
      EXPECT_THAT(error.what(), HasSubstr(why));
    }
  }
  EXPECT_THROW(TreeOf(*ball, "nobody"), ModelError);
}

}  // namespace
}  // namespace understudy::mjcf
