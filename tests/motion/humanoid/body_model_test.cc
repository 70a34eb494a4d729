// Compares a humanoid's body model with the simulated world.
#include "motion/humanoid/body_model.h"

#include <random>
#include <string_view>

#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "tests/motion/rig.h"
#include "tests/support/mujoco_test.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

Eigen::Vector3d Vector(const mjtNum* x) { return {x[0], x[1], x[2]}; }

// The robot in the air, every joint somewhere and everything turning.
class BodyModelTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {
 protected:
  BodyModelTest() {
    const mjModel& m = world_.model();
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-0.3, 0.3);
    for (int i = 0; i < m.nq; ++i) data_->qpos[i] = any(random);
    for (int i = 0; i < m.nv; ++i) data_->qvel[i] = any(random);
    data_->qpos[2] = 2;
    data_->qpos[3] = 1;
    mju_normalize4(data_->qpos + 3);
    mj_forward(&m, data_.get());
    mj_subtreeVel(&m, data_.get());
    for (const robot::MotorSpec& motor : spec_.motors) {
      const int joint = mj_name2id(&m, mjOBJ_JOINT, motor.joint.c_str());
      dof_.push_back(m.jnt_dofadr[joint]);
      q_.push_back(data_->qpos[m.jnt_qposadr[joint]]);
      dq_.push_back(data_->qvel[dof_.back()]);
    }
    const int site = mj_name2id(&m, mjOBJ_SITE, spec_.imu.site.c_str());
    mjtNum quat[4], velocity[6];
    mju_mat2Quat(quat, data_->site_xmat + 9 * site);
    imu_.R_WI = Eigen::Quaterniond(quat[0], quat[1], quat[2], quat[3]);
    mj_objectVelocity(&m, data_.get(), mjOBJ_SITE, site, velocity, 1);
    imu_.w_WI_I = Vector(velocity);
    body_.Update(q_, dq_, imu_);
  }

  // Middle between the centres of the soles; the geoms of a foot are the corners of its sole.
  physics::PointReading Soles() const {
    physics::PointReading middle;
    for (const robot::FootSpec& foot : spec_.feet) {
      for (const std::string& name : foot.geoms) {
        const int geom = mj_name2id(&world_.model(), mjOBJ_GEOM, name.c_str());
        mjtNum velocity[6];
        mj_objectVelocity(&world_.model(), data_.get(), mjOBJ_GEOM, geom, velocity, 0);
        const double share = 1.0 / static_cast<double>(2 * foot.geoms.size());
        middle.p_WP += share * Vector(data_->geom_xpos + 3 * geom);
        middle.v_WP_W += share * Vector(velocity + 3);
      }
    }
    return middle;
  }
  const mjtNum* OfBase(const mjtNum* all) const {
    return all + 3 * world_.robot().Body(spec_.base_body);
  }

  config::Config config_ = ConfigOf(GetParam());
  const robot::RobotSpec& spec_ = config_.robots[0].spec;
  physics::MujocoWorld world_ = PhysicsOf(config_);
  mjcf::DataHandle data_{mj_makeData(&world_.model())};
  BodyModel body_{world_.model(), spec_};
  std::vector<int> dof_;
  std::vector<double> q_, dq_;
  robot::ImuReading imu_;
};

// The spheres under a sole have their centres a radius over it and are not always symmetrical.
constexpr double kSphere = 0.03;  // m

TEST_P(BodyModelTest, FindsTheAttitudeOfTheBaseWhereverTheUnitIs) {
  const Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>> R_WB(
      data_->xmat + 9 * world_.robot().Body(spec_.base_body));
  EXPECT_LT((body_.attitude() - R_WB).norm(), 1e-9);
  mjtNum velocity[6];
  mj_objectVelocity(&world_.model(), data_.get(), mjOBJ_XBODY, world_.robot().Body(spec_.base_body),
                    velocity, 0);
  EXPECT_LT((body_.base_rate() - Vector(velocity)).norm(), 1e-9);
}

TEST_P(BodyModelTest, FindsTheCentreOfMassFromTheSoles) {
  EXPECT_NEAR(body_.mass() * body_.gravity(), world_.robot().weight(), 1e-9);
  const Eigen::Vector3d truth = Vector(OfBase(data_->subtree_com)) - Soles().p_WP;
  EXPECT_LT((body_.com() - truth).norm(), kSphere) << (body_.com() - truth).transpose();
  const Eigen::Vector3d between = body_.com() - body_.base();
  const Eigen::Vector3d exactly = Vector(OfBase(data_->subtree_com)) - Vector(OfBase(data_->xpos));
  EXPECT_LT((between - exactly).norm(), 1e-9);
}

TEST_P(BodyModelTest, FindsHowFastTheCentreOfMassPassesTheSoles) {
  const Eigen::Vector3d truth = Vector(OfBase(data_->subtree_linvel)) - Soles().v_WP_W;
  EXPECT_LT((body_.com_velocity() - truth).norm(), kSphere);
  mjtNum velocity[6];
  mj_objectVelocity(&world_.model(), data_.get(), mjOBJ_XBODY, world_.robot().Body(spec_.base_body),
                    velocity, 0);
  const Eigen::Vector3d between = body_.com_velocity() - body_.base_velocity();
  const Eigen::Vector3d exactly = Vector(OfBase(data_->subtree_linvel)) - Vector(velocity + 3);
  EXPECT_LT((between - exactly).norm(), 1e-9);
}

TEST_P(BodyModelTest, CarriesWhatHangsFromEachJoint) {
  mju_zero(data_->qvel, static_cast<int>(world_.model().nv));
  mj_forward(&world_.model(), data_.get());
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    EXPECT_NEAR(body_.GravityTorque(i), data_->qfrc_bias[dof_[i]], 1e-9) << spec_.motors[i].joint;
  }
}

TEST_P(BodyModelTest, PressesItsSolesByTheTransposedJacobian) {
  const mjModel& m = world_.model();
  const Eigen::Vector3d force(3, -5, 70), moment(2, 1, -4);
  for (std::size_t foot = 0; foot < 2; ++foot) {
    std::vector<double> tau(dof_.size());
    body_.AddGroundReaction(foot, force, moment, tau);
    // The same wrench where the world has that sole's centre.
    const Eigen::Vector3d p = Vector(OfBase(data_->xpos)) - body_.base() + body_.soles()[foot].p_OS;
    const int geom = mj_name2id(&m, mjOBJ_GEOM, spec_.feet[foot].geoms.front().c_str());
    std::vector<mjtNum> applied(static_cast<std::size_t>(m.nv));
    mj_applyFT(&m, data_.get(), force.data(), moment.data(), p.data(), m.geom_bodyid[geom],
               applied.data());
    for (std::size_t i = 0; i < dof_.size(); ++i) {
      EXPECT_NEAR(tau[i], -applied[static_cast<std::size_t>(dof_[i])], 1e-9);
    }
  }
}

TEST_P(BodyModelTest, KnowsLegsFromArms) {
  double legs = 0;
  for (std::size_t i = 0; i < dof_.size(); ++i) {
    const std::string& name = spec_.motors[i].joint;
    const bool leg = name.find("hip") != std::string::npos ||
                     name.find("knee") != std::string::npos ||
                     name.find("ankle") != std::string::npos;
    EXPECT_EQ(body_.IsOfLeg(i), leg) << name;
    EXPECT_GT(body_.FeltInertia(i), 0.001) << name;
    legs += leg ? 1 : 0;
  }
  EXPECT_GE(legs, 10);
}

TEST_P(BodyModelTest, FindsSolesOfTheSizeOfAFoot) {
  ASSERT_EQ(body_.soles().size(), 2U);
  for (const Sole& sole : body_.soles()) {
    EXPECT_GT(sole.half_length, 0.06);
    EXPECT_LT(sole.half_length, 0.16);
    EXPECT_GT(sole.half_width, 0.01);
    EXPECT_LT(sole.half_width, 0.05);
    EXPECT_NEAR(sole.forward.norm(), 1, 1e-9);
    EXPECT_NEAR(sole.up.norm(), 1, 1e-9);
  }
}

TEST_P(BodyModelTest, FindsSolesThatTheModelDoesNotName) {
  robot::RobotSpec spec = spec_;
  for (robot::FootSpec& foot : spec.feet) foot.geoms = {"none"};
  const BodyModel found(world_.model(), spec);
  const BodyModel named(world_.model(), spec_);
  for (std::size_t foot = 0; foot < 2; ++foot) {
    EXPECT_EQ(found.soles()[foot].half_length, named.soles()[foot].half_length);
    EXPECT_EQ(found.soles()[foot].half_width, named.soles()[foot].half_width);
    EXPECT_EQ(found.soles()[foot].p_OS, named.soles()[foot].p_OS);
  }
}

// Fingers hang from the wrists as they are, which the model takes to be stretched.
INSTANTIATE_TEST_SUITE_P(Robots, BodyModelTest, testing::ValuesIn(test::HumanoidsWithoutHands()),
                         [](const auto& test) { return test.param; });

using BodyModelMisuseTest = test::MujocoTest;

// Such as of Menagerie's g1_mjx.xml, whose feet meet the ground of scene_mjx.xml by pairs.
TEST_F(BodyModelMisuseTest, SaysOfAFootWithoutGeomsWhatHelps) {
  const physics::MujocoWorld world = PhysicsOf(ConfigOf("g1"));
  robot::RobotSpec spec = world.robot().spec();
  spec.feet[1] = {.name = "tail", .geoms = {"none"}};
  try {
    const BodyModel taken(world.model(), spec);
    FAIL() << "took it";
  } catch (const ModelError& error) {
    for (const char* const word : {"'tail'", "contype", "<pair>", "scene", "robot.feet.1.geoms"}) {
      EXPECT_NE(std::string_view(error.what()).find(word), std::string_view::npos) << error.what();
    }
  }
}

TEST_F(BodyModelMisuseTest, RefusesAFootWithoutGeoms) {
  const physics::MujocoWorld world = PhysicsOf(ConfigOf("g1"));
  robot::RobotSpec spec = world.robot().spec();
  spec.feet[1] = {.name = "tail", .geoms = {"none"}};
  EXPECT_THROW(BodyModel(world.model(), spec), ModelError);
  spec.feet.clear();
  EXPECT_THROW(BodyModel(world.model(), spec), ModelError);
}

}  // namespace
}  // namespace understudy::motion
