#include "mjcf/urdf_inertial.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "mjcf/urdf_reader.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using testing::HasSubstr;
using testing::IsEmpty;

const Matrix3d kTurn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, 3).normalized()).toRotationMatrix();

Matrix3d Turned(const Vector3d& moments) {
  return kTurn * moments.asDiagonal() * kTurn.transpose();
}

Vector3d Moments(const Matrix3d& inertia) {
  return Eigen::SelfAdjointEigenSolver<Matrix3d>(inertia).eigenvalues();
}

TEST(RepairedInertiaTest, LeavesWhatABodyCanHave) {
  EXPECT_EQ(RepairedInertia(Turned({0.01, 0.02, 0.025}), 1), std::nullopt);
  EXPECT_EQ(RepairedInertia(Turned({0.01, 0.02, 0.03}), 1), std::nullopt);  // a flat plate
}

TEST(RepairedInertiaTest, RaisesTheSmallerMomentsUntilTheyReachTheLargest) {
  const auto repaired = RepairedInertia(Turned({0.01, 0.02, 0.05}), 1);
  ASSERT_TRUE(repaired.has_value());
  EXPECT_LT((Moments(*repaired) - Vector3d(0.02, 0.03, 0.05)).norm(), 1e-9);
  EXPECT_LT((*repaired - Turned({0.02, 0.03, 0.05})).norm(), 1e-9) << "the axes stay";
}

TEST(RepairedInertiaTest, RaisesAMomentBelowZero) {
  const auto repaired = RepairedInertia(Turned({-0.01, 0.02, 0.02}), 1);
  ASSERT_TRUE(repaired.has_value());
  EXPECT_LT((Moments(*repaired) - Vector3d(0.00002, 0.02, 0.02)).norm(), 1e-9);
}

TEST(RepairedInertiaTest, TakesABallOfWaterForWhatHasNone) {
  const auto repaired = RepairedInertia(Matrix3d::Zero(), 1);
  ASSERT_TRUE(repaired.has_value());
  // 0.4 m r², r 62 mm of a litre
  EXPECT_LT((*repaired - 0.00153935 * Matrix3d::Identity()).norm(), 1e-7);
}

constexpr char kUrdf[] = R"(<robot name="r">
  <link name="base"><inertial><mass value="1"/>
    <inertia ixx=".01" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <link name="lidar"><inertial><mass value=".3"/><origin rpy=".1 .2 .3" xyz="0 0 1"/>
    <inertia ixx="IXX" iyy=".01" izz=".01" ixy="0" ixz="0" iyz="0"/></inertial></link>
  <joint name="j" type="KIND"><parent link="base"/><child link="lidar"/></joint></robot>)";

class UrdfInertialTest : public test::MujocoTest {
 protected:
  UrdfRobot Read(const std::string& ixx, const std::string& kind) {
    std::string text = kUrdf;
    text.replace(text.find("IXX"), 3, ixx);
    text.replace(text.find("KIND"), 4, kind);
    return ReadUrdf(folder_.Write("robot.urdf", text));
  }
  test::TemporaryFolder folder_;
};

// MuJoCo takes what is made of any inertia.
TEST_F(UrdfInertialTest, NamesTheLinkOfARepairedInertiaOnceAndMujocoTakesIt) {
  for (const char* ixx : {"0", "-1", "1e-30", "0.5", "1e6"}) {
    for (const char* kind : {"fixed", "continuous"}) {
      const UrdfRobot robot = Read(ixx, kind);
      ASSERT_EQ(robot.notes.size(), 1u) << ixx;
      EXPECT_THAT(robot.notes[0], HasSubstr("link 'lidar': no body has"));
      const auto model =
          physics::LoadModelFile(folder_.Write("robot.xml", IndentedMjcf(robot.model, "")));
      EXPECT_NEAR(model->body_mass[mj_name2id(model.get(), mjOBJ_BODY, "lidar")], 0.3, 1e-12);
    }
  }
}

TEST_F(UrdfInertialTest, SaysNothingOfASoundInertia) {
  EXPECT_THAT(Read("0.015", "continuous").notes, IsEmpty());
}

}  // namespace
}  // namespace understudy::mjcf
