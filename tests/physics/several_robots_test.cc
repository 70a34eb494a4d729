#include <cmath>
#include <cstring>
#include <numeric>

#include <gmock/gmock.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "config/load.h"
#include "physics/mujoco_world.h"
#include "physics/world_model.h"
#include "tests/support/fixture_robot.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/temporary_folder.h"

namespace understudy::physics {
namespace {

using testing::ElementsAreArray;
using testing::HasSubstr;

const std::filesystem::path kSource(UNDERSTUDY_SOURCE_DIR);

PlacedRobot Fixture(const std::string& prefix, double x, double y) {
  const robot::RobotSpec spec = test::FixtureRobot();
  return {.spec = spec, .file = spec.model, .prefix = prefix, .x = x, .y = y};
}

PlacedRobot OfProject(const std::string& name, double x) {
  const robot::RobotSpec spec =
      config::LoadConfig({.robot = name, .files = {}, .sets = {}}, kSource).robots[0].spec;
  return {.spec = spec, .file = kSource / "models" / spec.model, .prefix = name + "/", .x = x};
}

MujocoWorld Load(const std::vector<PlacedRobot>& robots, const std::filesystem::path& scene,
                 LoadNotes* notes = nullptr) {
  return {LoadWorldModel(robots, scene, 0.001, notes), robots};
}

// All that a robot has in qpos and qvel.
std::vector<double> State(const RobotBody& robot) {
  std::vector<double> state(robot.q().begin(), robot.q().end());
  state.insert(state.end(), robot.dq().begin(), robot.dq().end());
  for (int i = 0; i < 3; ++i) {
    state.push_back(robot.base().p_WB[i]);
    state.push_back(robot.base().v_WB_W[i]);
  }
  return state;
}

void StandFor(int steps, MujocoWorld* world, std::size_t robots) {
  for (int step = 0; step < steps; ++step) {
    world->BeginStep();
    for (std::size_t i = 0; i < robots; ++i) {
      RobotBody& robot = world->robot(i);
      robot.Drive(test::Hold(robot, robot.spec().standing.q));
    }
    ASSERT_EQ(world->EndStep(), StepHealth::kFine);
  }
}

// Two fixtures far enough apart not to touch; the second begins 3 m ahead and 1 m to the left.
class TwoRobotsTest : public test::MujocoTest {
 protected:
  TwoRobotsTest() {
    a_.Reset(spec_.standing);
    b_.Reset(spec_.standing);
  }

  const robot::RobotSpec spec_ = test::FixtureRobot();
  MujocoWorld world_ =
      Load({Fixture("a/", 0, 0), Fixture("b/", 3, 1)}, test::FixtureFile("fixture_ground.xml"));
  RobotBody& a_ = world_.robot(0);
  RobotBody& b_ = world_.robot(1);
};

TEST_F(TwoRobotsTest, EachStandsInItsPlace) {
  EXPECT_EQ(a_.base().p_WB, Eigen::Vector3d(0, 0, 0.3));
  EXPECT_EQ(b_.base().p_WB, Eigen::Vector3d(3, 1, 0.3));
  EXPECT_NEAR(a_.weight(), 60, 1e-9);
  EXPECT_NEAR(b_.weight(), 60, 1e-9);
}

TEST_F(TwoRobotsTest, EachFindsItsOwnBodiesOnly) {
  EXPECT_EQ(world_.FindBody("base"), -1);
  EXPECT_EQ(a_.Body("base"), world_.FindBody("a/base"));
  EXPECT_EQ(b_.Body("base"), world_.FindBody("b/base"));
  EXPECT_EQ(a_.FindBody("b/base"), -1);
  EXPECT_THROW((void)a_.Body("b/base"), ModelError);
}

TEST_F(TwoRobotsTest, EachReadsItsOwnJoints) {
  a_.Reset({.q = {0.1, 0.2, 0.3, 0.4, 0.5, 0.6}, .height = 1});
  b_.Reset({.q = {-0.1, -0.2, -0.3, -0.4, -0.5, -0.6}, .height = 1});
  EXPECT_THAT(a_.q(), ElementsAreArray({0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
  EXPECT_THAT(b_.q(), ElementsAreArray({-0.1, -0.2, -0.3, -0.4, -0.5, -0.6}));
}

TEST_F(TwoRobotsTest, EachReadsItsOwnUnitsAndFeet) {
  b_.Reset({.q = spec_.standing.q, .height = 5});  // falls while the other one stands
  StandFor(500, &world_, 2);
  EXPECT_NEAR(a_.Imu().f_WI_I.z(), 10, 0.5);
  EXPECT_NEAR(b_.Imu().f_WI_I.norm(), 0, 1e-6);
  EXPECT_NEAR(a_.SecondaryImu().f_WI_I.z(), -10, 0.5);  // it is upside down
  EXPECT_NEAR(b_.SecondaryImu().f_WI_I.norm(), 0, 1e-6);
  std::vector<double> force(4);
  a_.FootForces(force);
  EXPECT_NEAR(std::accumulate(force.begin(), force.end(), 0.0), 60, 2);
  b_.FootForces(force);
  EXPECT_EQ(force, std::vector<double>(4, 0.0));
}

TEST_F(TwoRobotsTest, TorqueOnOneDoesNotMoveTheOther) {
  for (RobotBody* robot : {&a_, &b_}) robot->Reset({.q = spec_.standing.q, .height = 5});
  a_.Drive(std::vector<double>(6, 0.5));
  for (int step = 0; step < 100; ++step) {
    world_.BeginStep();
    ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  }
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_GT(a_.dq()[i], 0.1) << i;
    EXPECT_NEAR(b_.dq()[i], 0, 1e-9) << i;
  }
}

TEST_F(TwoRobotsTest, OneIsClampedWithoutTheOther) {
  a_.Clamp(true);
  EXPECT_TRUE(a_.clamped());
  EXPECT_FALSE(b_.clamped());
  b_.Clamp(true);
  b_.Reset(spec_.standing);
  EXPECT_TRUE(a_.clamped()) << "a reset lets go of one's own base";
  EXPECT_FALSE(b_.clamped());
}

TEST_F(TwoRobotsTest, ResetOfOneLeavesTheOther) {
  a_.Reset({.q = spec_.standing.q, .height = 2});
  b_.Reset({.q = spec_.standing.q, .height = 2});
  a_.Drive(std::vector<double>(6, 0.5));
  b_.Drive(std::vector<double>(6, -0.5));
  world_.BeginStep();
  ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  world_.BeginStep();
  const std::vector<double> before = State(a_);
  b_.Reset(spec_.standing);
  EXPECT_EQ(State(a_), before);
  EXPECT_EQ(b_.base().p_WB, Eigen::Vector3d(3, 1, 0.3));
  ASSERT_EQ(world_.EndStep(), StepHealth::kFine);
  world_.BeginStep();
  for (const double rate : a_.dq()) EXPECT_GT(std::abs(rate), 1e-3) << "its torque still acts";
  for (const double rate : b_.dq()) EXPECT_NEAR(rate, 0, 1e-9) << "its torque is gone";
}

TEST_F(TwoRobotsTest, ResetOfTheWorldPutsAllBack) {
  StandFor(10, &world_, 2);
  world_.Reset();
  a_.Reset(spec_.standing);
  EXPECT_EQ(a_.base().p_WB, Eigen::Vector3d(0, 0, 0.3));
  EXPECT_EQ(b_.base().p_WB, Eigen::Vector3d(3, 1, 0.3));
}

// A Go2 and a G1, whose files have different defaults, contact classes and options.
class Go2AndG1Test : public test::MujocoTest {
 protected:
  const std::filesystem::path flat_ = kSource / "models/scene/flat.xml";
  const PlacedRobot go2_ = OfProject("go2", 0);
  const PlacedRobot g1_ = OfProject("g1", 4);
};

TEST_F(Go2AndG1Test, MoveAsTheyDoAlone) {
  MujocoWorld both = Load({go2_, g1_}, flat_);
  PlacedRobot only = go2_;
  only.prefix = "";
  MujocoWorld alone = Load({only}, flat_);
  both.robot(0).Reset(go2_.spec.standing);
  both.robot(1).Reset(g1_.spec.hanging);
  both.robot(1).Clamp(true);
  alone.robot().Reset(go2_.spec.standing);
  for (int step = 0; step < 500; ++step) {
    for (MujocoWorld* world : {&both, &alone}) {
      world->BeginStep();
      world->robot().Drive(test::Hold(world->robot(), go2_.spec.lying.q));
      ASSERT_EQ(world->EndStep(), StepHealth::kFine);
    }
    const std::vector<double> got = State(both.robot()), expected = State(alone.robot());
    // The solver stops within its tolerance, with two robots elsewhere than with one.
    for (std::size_t i = 0; i < got.size(); ++i) ASSERT_NEAR(got[i], expected[i], 3e-3) << step;
  }
  EXPECT_NEAR(both.robot(1).base().p_WB.x(), 4, 0.01);
}

// What the compiler makes of each joint, geom and body is the same with a prefix as without.
TEST_F(Go2AndG1Test, HaveTheFiguresTheyHaveAlone) {
  const MujocoWorld both = Load({go2_, g1_}, flat_);
  const mjModel& joined = both.model();
  for (PlacedRobot robot : {go2_, g1_}) {
    const std::string prefix = std::exchange(robot.prefix, "");
    const MujocoWorld world = Load({robot}, flat_);
    const mjModel& own = world.model();
    int compared = 0;
    const auto expect_same = [&](mjtObj type, int id, const auto& of, const char* what, int count) {
      const char* name = mj_id2name(&own, type, id);
      if (name == nullptr || *name == '\0') return;
      const int other = mj_name2id(&joined, type, (prefix + name).c_str());
      if (other < 0) return;  // of the scene
      ++compared;
      for (int i = 0; i < count; ++i) {
        EXPECT_EQ(of(joined)[count * other + i], of(own)[count * id + i]) << name << " " << what;
      }
    };
#define SAME(type, field, count) \
  expect_same(                   \
      type, id, [](const mjModel& m) { return m.field; }, #field, count)
    for (int id = 0; id < own.njnt; ++id) {
      SAME(mjOBJ_JOINT, jnt_limited, 1);
      SAME(mjOBJ_JOINT, jnt_range, 2);
      SAME(mjOBJ_JOINT, jnt_axis, 3);
      const int dof = own.jnt_dofadr[id];
      const char* name = mj_id2name(&own, mjOBJ_JOINT, id);
      if (name == nullptr || *name == '\0') continue;
      const int other =
          joined.jnt_dofadr[mj_name2id(&joined, mjOBJ_JOINT, (prefix + name).c_str())];
      EXPECT_EQ(joined.dof_armature[other], own.dof_armature[dof]) << name;
      EXPECT_EQ(joined.dof_damping[other], own.dof_damping[dof]) << name;
      EXPECT_EQ(joined.dof_frictionloss[other], own.dof_frictionloss[dof]) << name;
    }
    for (int id = 0; id < own.ngeom; ++id) {
      SAME(mjOBJ_GEOM, geom_type, 1);
      SAME(mjOBJ_GEOM, geom_size, 3);
      SAME(mjOBJ_GEOM, geom_friction, 3);
      SAME(mjOBJ_GEOM, geom_contype, 1);
      SAME(mjOBJ_GEOM, geom_conaffinity, 1);
      SAME(mjOBJ_GEOM, geom_condim, 1);
      SAME(mjOBJ_GEOM, geom_priority, 1);
    }
    for (int id = 1; id < own.nbody; ++id) {
      SAME(mjOBJ_BODY, body_mass, 1);
      SAME(mjOBJ_BODY, body_inertia, 3);
    }
#undef SAME
    EXPECT_GT(compared, 80);
  }
}

TEST_F(Go2AndG1Test, HaveSparseConstraintsOnlyTogether) {
  EXPECT_EQ(Load({go2_, g1_}, flat_).model().opt.jacobian, mjJAC_SPARSE);
  PlacedRobot only = go2_;
  only.prefix = "";
  EXPECT_EQ(Load({only}, flat_).model().opt.jacobian, mjJAC_AUTO);
}

TEST_F(Go2AndG1Test, HaveTheOptionsOfTheFirst) {
  LoadNotes notes;
  EXPECT_EQ(Load({go2_, g1_}, flat_, &notes).model().opt.cone, mjCONE_ELLIPTIC);
  EXPECT_THAT(notes.warnings, testing::IsEmpty());
  EXPECT_EQ(Load({g1_, go2_}, flat_, &notes).model().opt.cone, mjCONE_PYRAMIDAL);
  EXPECT_THAT(notes.warnings, testing::Contains(HasSubstr("cone=\"elliptic\" is left out")));
}

// The fixture's file leaves limits to autolimits, the Go2's switches them off; the fixture's
// defaults have no name.
TEST_F(Go2AndG1Test, StandBesideARobotWithOtherDefaults) {
  const MujocoWorld world = Load({go2_, Fixture("f/", 4, 0)}, flat_);
  const mjModel& model = world.model();
  const int trunk = mj_name2id(&model, mjOBJ_GEOM, "f/trunk");
  EXPECT_EQ(model.geom_conaffinity[trunk], 0);
  const int joint = mj_name2id(&model, mjOBJ_JOINT, "f/FR_joint");
  EXPECT_EQ(model.dof_damping[model.jnt_dofadr[joint]], 0.1);
  const int floor = mj_name2id(&model, mjOBJ_GEOM, "floor");
  EXPECT_EQ(model.geom_conaffinity[floor], 1) << "the fixture's defaults are not the scene's";
}

TEST_F(Go2AndG1Test, AreRefusedBesideAFileThatCountsInDegrees) {
  const test::TemporaryFolder folder;
  PlacedRobot other = Fixture("f/", 4, 0);
  other.spec = {};
  other.spec.name = "box";
  other.spec.base_body = other.spec.crane_body = "box";
  other.spec.imu.site = "imu";
  other.file = folder.Write("box.xml", R"(<mujoco><worldbody><body name="box" pos="0 0 1">
      <freejoint/><geom size="0.1" mass="1"/><site name="imu"/></body></worldbody></mujoco>)");
  try {
    (void)LoadWorldModel({go2_, other}, flat_, 0.001);
    FAIL();
  } catch (const ModelError& error) {
    EXPECT_THAT(error.what(), HasSubstr("box.xml:1: <compiler> angle=\"degree\""));
  }
}

}  // namespace
}  // namespace understudy::physics
