#include "mjcf/fit_names.h"

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "physics/feet.h"
#include "physics/world_model.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::mjcf {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

// A walker by another hand: two legs of two joints, unnamed soles of two spheres each, a shin that
// ends above them, and an arm.
constexpr char kWalker[] = R"(<mujoco><worldbody>
  <body name="trunk" pos="0 0 1"><freejoint/><geom size=".1"/><site name="trunk_imu"/>
    <body pos="0 .1 0"><joint name="left_hip"/><geom size=".05"/>
      <body name="left_shin" pos="0 0 -.4"><joint name="left_ankle"/>
        <geom type="capsule" fromto="0 0 0 0 0 -.2" size=".02"/>
        <geom size=".01" pos=".1 0 -.3"/>
        <geom size=".01" pos="-.1 0 -.295"/>
        <geom size=".01" pos="0 0 -.4" contype="0" conaffinity="0"/></body></body>
    <body pos="0 -.1 0"><joint name="right_hip"/><geom size=".05"/>
      <body pos="0 0 -.4"><joint name="right_ankle"/>
        <body pos="0 0 -.3"><geom size=".01"/></body></body></body>
    <body pos="0 .3 0"><joint name="left_elbow"/><geom size=".05"/><site name="IMU_hand"/></body>
  </body></worldbody></mujoco>)";

class FitNamesTest : public test::MujocoTest {
 protected:
  FitNamesTest() {
    spec_.base_body = spec_.crane_body = "pelvis";
    spec_.imu = {.site = "imu", .secondary_site = "imu2"};
    for (const char* joint : {"left_hip_joint", "left_ankle_joint", "right_hip_joint",
                              "right_ankle_joint", "left_elbow_joint"}) {
      robot::MotorSpec motor;
      motor.joint = joint;
      motor.slot = static_cast<int>(spec_.motors.size());
      spec_.motors.push_back(motor);
    }
    spec_.lying.q = spec_.standing.q = spec_.hanging.q = {0, 1, 2, 3, 4};
    spec_.feet = {{.name = "left_foot", .geoms = {"left_sole"}},
                  {.name = "right_foot", .geoms = {"right_sole"}}};
  }

  robot::RobotSpec Fit(const std::string& model = kWalker) {
    model_ = physics::LoadModelFile(folder_.Write("robot.xml", model));
    notes_.clear();
    return FitNames(spec_, *model_, &notes_);
  }

  static std::string With(const std::string& old, const std::string& now) {
    std::string text = kWalker;
    return text.replace(text.find(old), old.size(), now);
  }

  test::TemporaryFolder folder_;
  robot::RobotSpec spec_;
  ModelHandle model_;
  std::vector<std::string> notes_;
};

TEST_F(FitNamesTest, ChangesNothingThatFits) {
  spec_ = Fit();
  EXPECT_THAT(notes_, testing::Not(IsEmpty()));
  const robot::RobotSpec again = Fit();
  EXPECT_THAT(notes_, IsEmpty());
  EXPECT_EQ(again.base_body, spec_.base_body);
}

TEST_F(FitNamesTest, TakesTheBodyThatMovesFreelyForTheBase) {
  const robot::RobotSpec spec = Fit();
  EXPECT_EQ(spec.base_body, "trunk");
  EXPECT_EQ(spec.crane_body, "trunk");
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("'pelvis': the model calls it 'trunk'")));
}

TEST_F(FitNamesTest, HangsTheRobotByItsBaseWhereTheCraneHasNoHook) {
  spec_.base_body = "trunk";
  spec_.crane_body = "torso";
  spec_.crane_point = {0, 0, 0.4};
  const robot::RobotSpec spec = Fit();
  EXPECT_EQ(spec.crane_body, "trunk");
  EXPECT_TRUE(spec.crane_point.isZero());
}

TEST_F(FitNamesTest, LeavesABaseAloneOfWhichThereAreTwo) {
  const robot::RobotSpec spec = Fit(
      With("</worldbody>", "<body name='ball'><freejoint/><geom size='.1'/></body></worldbody>"));
  EXPECT_EQ(spec.base_body, "pelvis");
}

TEST_F(FitNamesTest, ReadsJointsWithAndWithoutTheirEnding) {
  EXPECT_EQ(Fit().motors[1].joint, "left_ankle");
  spec_.motors[1].joint = "left_ankle";
  EXPECT_EQ(Fit(With("\"left_ankle\"", "\"left_ankle_joint\"")).motors[1].joint,
            "left_ankle_joint");
}

TEST_F(FitNamesTest, TakesTheOnlyImuOfTheBaseAndTheOnlyOneElsewhere) {
  const robot::RobotSpec spec = Fit();
  EXPECT_EQ(spec.imu.site, "trunk_imu");
  EXPECT_EQ(spec.imu.secondary_site, "IMU_hand");
}

TEST_F(FitNamesTest, GoesWithoutASecondUnitThatIsNotThere) {
  EXPECT_EQ(Fit(With("IMU_hand", "hand")).imu.secondary_site, "");
}

TEST_F(FitNamesTest, LeavesTheImuAloneWhereItCannotTell) {
  EXPECT_EQ(
      Fit(With("<site name=\"trunk_imu\"/>", "<site name='imu_a'/><site name='imu_b'/>")).imu.site,
      "imu");
}

TEST_F(FitNamesTest, PutsTheImuAtTheOriginOfTheBaseWhereTheModelHasNone) {
  std::string bare = With("<site name=\"trunk_imu\"/>", "");
  bare = bare.replace(bare.find("IMU_hand"), 8, "hand");
  const robot::RobotSpec spec = Fit(bare);
  ASSERT_EQ(spec.sites.size(), 1u);
  EXPECT_EQ(spec.sites[0].name, spec.imu.site);
  EXPECT_EQ(spec.imu.secondary_site, "");
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("no IMU site: the unit is at the origin of "
                                                  "'trunk'")));
}

TEST_F(FitNamesTest, LeavesOutAFewMotorsThatHaveNoJoint) {
  spec_.motors[2].joint = "head";
  spec_.parallel = {{.pitch = 0, .roll = 2}, {.pitch = 3, .roll = 4}};
  const robot::RobotSpec spec = Fit();
  ASSERT_EQ(spec.motors.size(), 4u);
  EXPECT_EQ(spec.motors[2].slot, 3);
  EXPECT_THAT(spec.lying.q, ElementsAre(0, 1, 3, 4));
  EXPECT_THAT(spec.hanging.q, ElementsAre(0, 1, 3, 4));
  ASSERT_EQ(spec.parallel.size(), 1u);
  EXPECT_EQ(spec.parallel[0].pitch, 2);
  EXPECT_EQ(spec.parallel[0].roll, 3);
  EXPECT_THAT(notes_, testing::Contains(HasSubstr("no joint 'head': slot 2 has no motor")));
}

TEST_F(FitNamesTest, LeavesAnotherRobotsMotorsAlone) {
  for (std::size_t i = 0; i < 3; ++i) spec_.motors[i].joint = "wing_" + std::to_string(i);
  EXPECT_EQ(Fit().motors.size(), 5u);
}

TEST_F(FitNamesTest, FindsTheFeetAtTheLowestOfEachSide) {
  const robot::RobotSpec spec = Fit();
  const DataHandle data(mj_makeData(model_.get()));
  mj_kinematics(model_.get(), data.get());
  std::vector<std::vector<double>> feet(2);
  const std::vector<int> foot_of_geom = physics::FindFeet(*model_, *data, spec);
  for (std::size_t geom = 0; geom < foot_of_geom.size(); ++geom) {
    if (foot_of_geom[geom] < 0) continue;
    feet[static_cast<std::size_t>(foot_of_geom[geom])].push_back(data->geom_xpos[3 * geom + 2]);
  }
  EXPECT_THAT(feet[0], ElementsAre(testing::DoubleEq(0.3), testing::DoubleEq(0.305)));
  EXPECT_THAT(feet[1], ElementsAre(testing::DoubleEq(0.3)));
}

TEST_F(FitNamesTest, FindsAFootThatMeetsTheGroundByAPairAlone) {
  std::string text = With("<geom size=\".01\"/></body></body></body>",
                          "<geom name='sole' size='.01' contype='0' conaffinity='0'/>"
                          "</body></body></body>");
  text.replace(text.find("</worldbody>"), 12,
               "<geom name='floor' type='plane' size='1 1 1'/></worldbody>"
               "<contact><pair geom1='sole' geom2='floor'/></contact>");
  const robot::RobotSpec spec = Fit(text);
  const DataHandle data(mj_makeData(model_.get()));
  mj_kinematics(model_.get(), data.get());
  const std::vector<int> foot_of_geom = physics::FindFeet(*model_, *data, spec);
  const int sole = mj_name2id(model_.get(), mjOBJ_GEOM, "sole");
  EXPECT_EQ(foot_of_geom[static_cast<std::size_t>(sole)], 1);
}

TEST_F(FitNamesTest, TakesTheGeomsThatAFootNames) {
  spec_.feet[0].geoms = {"toe", "heel"};
  const robot::RobotSpec spec =
      Fit(With("<geom size=\".05\"/><site", "<geom name='toe' size=\".05\"/><site"));
  const DataHandle data(mj_makeData(model_.get()));
  mj_kinematics(model_.get(), data.get());
  const std::vector<int> foot_of_geom = physics::FindFeet(*model_, *data, spec);
  EXPECT_EQ(std::ranges::count(foot_of_geom, 0), 1);
  EXPECT_EQ(foot_of_geom[static_cast<std::size_t>(mj_name2id(model_.get(), mjOBJ_GEOM, "toe"))], 0);
}

}  // namespace
}  // namespace understudy::mjcf
