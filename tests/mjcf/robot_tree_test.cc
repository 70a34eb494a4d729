#include "mjcf/robot_tree.h"

#include <map>
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

using Eigen::Isometry3d;
using testing::ElementsAre;

constexpr char kUnit[] = R"(<inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/>)";

class RobotTreeTest : public test::MujocoTest {
 protected:
  ModelHandle Compile(const std::string& base) {
    return CompileMjcf(
        ReadMjcf(folder_.Write("robot.xml", "<mujoco><compiler angle='radian'/><worldbody>" + base +
                                                "</worldbody></mujoco>")));
  }
  // At random places of all joints, links are where MuJoCo has their bodies.
  static void ExpectPlacesOfMujoco(const mjModel& model, const std::string& base) {
    const RobotTree tree = TreeOf(model, base);
    const DataHandle data = MakeDataWithoutContacts(model);
    std::mt19937 draw(3);
    for (int i = 0; i < model.nq; ++i) {
      data->qpos[i] = std::uniform_real_distribution<double>(-1, 1)(draw);
    }
    Isometry3d X_WB = tree.X_WB;
    if (tree.base_qpos >= 0) {
      mju_normalize4(data->qpos + tree.base_qpos + 3);
      X_WB = Eigen::Translation3d(Vector(data->qpos + tree.base_qpos)) *
             Quaternion(data->qpos + tree.base_qpos + 3);
    }
    mj_kinematics(&model, data.get());
    std::map<std::string, Isometry3d> at{{tree.base, X_WB}};
    std::size_t bodies = 0;
    for (const TreeJoint& joint : tree.joints) {
      ASSERT_TRUE(at.contains(joint.parent)) << joint.name;
      const double q = joint.qpos < 0 ? 0 : data->qpos[joint.qpos];
      at[joint.child] = at[joint.parent] * joint.At(q);
      if (joint.body < 0) continue;
      ++bodies;
      const Isometry3d expected = Eigen::Translation3d(Vector(data->xpos + 3 * joint.body)) *
                                  Quaternion(data->xquat + 4 * joint.body);
      EXPECT_TRUE(at[joint.child].isApprox(expected, 1e-9)) << joint.child;
    }
    EXPECT_GT(bodies, 0U);
    const int root = mj_name2id(&model, mjOBJ_BODY, base.c_str());
    EXPECT_TRUE(at[base].translation().isApprox(Vector(data->xpos + 3 * root), 1e-9));
  }

  test::TemporaryFolder folder_;
};

class RobotTreeOfRobotTest : public RobotTreeTest,
                             public testing::WithParamInterface<std::string> {};

TEST_P(RobotTreeOfRobotTest, PutsEveryLinkWhereMujocoHasItsBody) {
  const config::Config config = config::LoadConfig({.robot = GetParam()}, UNDERSTUDY_SOURCE_DIR);
  const ModelHandle model = physics::LoadSightModel(
      {{config.robots[0].spec,
        UNDERSTUDY_SOURCE_DIR + std::string("/models/") + config.robots[0].spec.model,
        config::HandModelFiles(config.robots[0].spec)}},
      std::filesystem::path(UNDERSTUDY_SOURCE_DIR "/models/scene/flat.xml"), 0.001);
  ExpectPlacesOfMujoco(*model, config.robots[0].spec.base_body);
  EXPECT_GE(TreeOf(*model, config.robots[0].spec.base_body).base_qpos, 0);
}

INSTANTIATE_TEST_SUITE_P(Robots, RobotTreeOfRobotTest,
                         testing::ValuesIn(config::RobotNames(UNDERSTUDY_SOURCE_DIR)),
                         [](const auto& one) { return one.param; });

// The reference of a joint is the place in which the file has its body.
TEST_F(RobotTreeTest, KnowsSeveralJointsOfABodySlidesAndReferences) {
  const std::string rest = std::string(kUnit) +
                           "<body name='arm' pos='0.1 0.2 0.3' euler='0.4 0.5 0.6'>"
                           "<joint name='roll' axis='1 0 0' pos='0 0.1 0' ref='0.3'/>"
                           "<joint name='pitch' axis='0 1 0' pos='0.1 0 0.2' ref='-0.5'/>" +
                           kUnit + "<body name='hand' pos='1 0 0' euler='0 1.57 0'>" +
                           "<joint name='slide' type='slide' axis='0 0.6 0.8' ref='0.1'/>" + kUnit +
                           "</body><body name='horn' pos='0 0 1'>" + kUnit +
                           "</body></body></body>";
  for (const std::string& base :
       {std::string("<body name='base'><freejoint/>"),
        std::string(
            "<body name='stand' pos='1 2 3' euler='0 0 1'><body name='base' pos='0 0 1'>")}) {
    const bool fixed = base.find("stand") != std::string::npos;
    const ModelHandle model = Compile(base + rest + (fixed ? "</body>" : ""));
    ExpectPlacesOfMujoco(*model, "base");
    const RobotTree tree = TreeOf(*model, "base");
    EXPECT_EQ(tree.base_qpos < 0, fixed);
    std::vector<std::string> links;
    for (const TreeJoint& joint : tree.joints) links.push_back(joint.child);
    EXPECT_THAT(links, ElementsAre("roll_place", "pitch_place", "arm", "hand", "horn"));
  }
}

TEST_F(RobotTreeTest, RefusesWhatUrdfHasNot) {
  EXPECT_THROW(TreeOf(*Compile("<body name='base'/>"), "nobody"), ModelError);
  EXPECT_THROW(
      TreeOf(*Compile(std::string("<body name='base'>") + kUnit +
                      "<body name='arm'><joint name='b' type='ball'/>" + kUnit + "</body></body>"),
             "base"),
      ModelError);
}

}  // namespace
}  // namespace understudy::mjcf
