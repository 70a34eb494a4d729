#include "motion/quadruped/leg.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "base/errors.h"
#include "motion/quadruped/body.h"
#include "tests/motion/rig.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const std::array<Vector3d, 4> kAngles{Vector3d(0, 0.8, -1.5), Vector3d(0.4, 1.2, -2.2),
                                      Vector3d(-0.6, 0.3, -0.9), Vector3d(-0.2, 2.4, -1.8)};

class QuadrupedLegTest : public testing::TestWithParam<std::string> {
 protected:
  config::Config config_ = ConfigOf(GetParam());
  physics::MujocoWorld world_ = PhysicsOf(config_);
  physics::RobotBody& robot_ = world_.robot();
  QuadrupedFigures figures_ = ReadQuadruped(robot_);
};

TEST_P(QuadrupedLegTest, PutsTheFootWhereTheModelHasIt) {
  for (const Vector3d& q : kAngles) {
    robot::PoseSpec pose = config_.robots[0].spec.standing;
    for (std::size_t i = 0; i < 12; ++i) pose.q[i] = q[static_cast<Eigen::Index>(i % 3)];
    pose.height = 2;
    robot_.Reset(pose);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const mjModel& model = world_.model();
      const int geom =
          mj_name2id(&model, mjOBJ_GEOM, config_.robots[0].spec.feet[leg].geoms[0].c_str());
      const Vector3d there(world_.data().geom_xpos + 3 * geom);
      const Vector3d foot = QuadrupedLeg(figures_.legs[leg]).Place(q).foot + robot_.base().p_WB;
      EXPECT_LT((foot - there).norm(), 1e-6) << "leg " << leg;
    }
  }
}

TEST_P(QuadrupedLegTest, ReachesEveryPlaceItsFootCanBe) {
  for (const LegFigures& figures : figures_.legs) {
    const QuadrupedLeg leg(figures);
    for (const Vector3d& q : kAngles) {
      Vector3d found;
      EXPECT_TRUE(leg.Reach(leg.Place(q).foot, &found));
      EXPECT_LT((found - q).norm(), 1e-6) << found.transpose() << " for " << q.transpose();
    }
  }
}

TEST_P(QuadrupedLegTest, StretchesTowardsWhatIsOutOfReach) {
  const QuadrupedLeg leg(figures_.legs[0]);
  Vector3d q;
  EXPECT_FALSE(leg.Reach(figures_.legs[0].hip + Vector3d(0, 0, -3), &q));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_GE(q[static_cast<Eigen::Index>(i)], figures_.legs[0].low[i]);
    EXPECT_LE(q[static_cast<Eigen::Index>(i)], figures_.legs[0].high[i]);
  }
  EXPECT_LT(leg.Place(q).foot.z(), -0.8 * leg.length());
}

TEST_P(QuadrupedLegTest, JacobianIsTheFootsRate) {
  constexpr double kStep = 1e-6;
  for (const LegFigures& figures : figures_.legs) {
    const QuadrupedLeg leg(figures);
    for (const Vector3d& q : kAngles) {
      const Matrix3d jacobian = FootJacobian(leg.Place(q));
      for (int i = 0; i < 3; ++i) {
        const Vector3d step = kStep * Vector3d::Unit(i);
        const Vector3d rate = (leg.Place(q + step).foot - leg.Place(q - step).foot) / (2 * kStep);
        EXPECT_LT((rate - jacobian.col(i)).norm(), 1e-6);
      }
    }
  }
}

// The work of lifting is what the torque does: its potential energy's slope.
TEST_P(QuadrupedLegTest, HoldsItsOwnWeight) {
  constexpr double kStep = 1e-6;
  const Vector3d up = Vector3d(0.2, -0.3, 0.9).normalized();
  for (const LegFigures& figures : figures_.legs) {
    const QuadrupedLeg leg(figures);
    for (const Vector3d& q : kAngles) {
      const Vector3d torque = leg.HoldingTorque(leg.Place(q), up, 10);
      for (int i = 0; i < 3; ++i) {
        const Vector3d step = kStep * Vector3d::Unit(i);
        const double rise =
            (leg.MassMoment(leg.Place(q + step)) - leg.MassMoment(leg.Place(q - step))).dot(up);
        EXPECT_NEAR(torque[i], 10 * rise / (2 * kStep), 1e-6);
      }
    }
  }
}

TEST_P(QuadrupedLegTest, HasTheInertiaThatTheModelHas) {
  const mjModel& model = world_.model();
  const auto size = static_cast<std::size_t>(model.nv);
  std::vector<mjtNum> full(size * size);
  for (const Vector3d& q : kAngles) {
    robot::PoseSpec pose = config_.robots[0].spec.standing;
    for (std::size_t i = 0; i < 12; ++i) pose.q[i] = q[static_cast<Eigen::Index>(i % 3)];
    pose.height = 2;
    robot_.Reset(pose);
    world_.BeginStep();
    for (std::size_t i = 0; i < size; ++i) {
      std::vector<mjtNum> unit(size);
      unit[i] = 1;
      mj_mulM(&model, &world_.data(), &full[i * size], unit.data());
    }
    for (std::size_t leg = 0; leg < 4; ++leg) {
      const QuadrupedLeg chain(figures_.legs[leg]);
      const Matrix3d mass = chain.MassMatrix(chain.Place(q));
      const auto dof = [&](int i) {
        const std::string& joint =
            config_.robots[0].spec.motors[3 * leg + static_cast<std::size_t>(i)].joint;
        return model.jnt_dofadr[mj_name2id(&model, mjOBJ_JOINT, joint.c_str())];
      };
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) {
          const mjtNum there =
              full[static_cast<std::size_t>(dof(i)) * size + static_cast<std::size_t>(dof(j))];
          EXPECT_NEAR(mass(i, j), there, 1e-3 * mass(i, i)) << "leg " << leg;
        }
      }
    }
  }
}

TEST_P(QuadrupedLegTest, LosesByFrictionWhatTheModelsJointsLose) {
  const mjModel& model = world_.model();
  const int joint = mj_name2id(&model, mjOBJ_JOINT, config_.robots[0].spec.motors[2].joint.c_str());
  const int dof = model.jnt_dofadr[joint];
  const QuadrupedLeg leg(figures_.legs[0]);
  EXPECT_NEAR(leg.FrictionTorque({0, 0, 5}).z(),
              5 * model.dof_damping[dof] + model.dof_frictionloss[dof], 1e-6);
  EXPECT_EQ(leg.FrictionTorque({0, 0, -5}).z(), -leg.FrictionTorque({0, 0, 5}).z());
}

// A real service does not know what was drawn for this run.
TEST_P(QuadrupedLegTest, KnowsItselfAsItWasBuilt) {
  mjcf::ModelHandle heavier = mjcf::CopyOf(world_.model());
  for (int body = 0; body < heavier->nbody; ++body) heavier->body_mass[body] *= 1.5;
  const physics::MujocoWorld world(std::move(heavier), {{config_.robots[0].spec}},
                                   mjcf::CopyOf(world_.model()));
  EXPECT_EQ(ReadQuadruped(world.robot()).mass, figures_.mass);
  EXPECT_EQ(ReadQuadruped(world.robot()).trunk.mass, figures_.trunk.mass);
}

TEST_P(QuadrupedLegTest, FindsFeetThatTheModelDoesNotName) {
  robot::RobotSpec spec = config_.robots[0].spec;
  for (robot::FootSpec& foot : spec.feet) foot.geoms = {"none"};
  const physics::MujocoWorld world(mjcf::CopyOf(world_.model()), {{spec}});
  const QuadrupedFigures found = ReadQuadruped(world.robot());
  for (std::size_t leg = 0; leg < 4; ++leg) {
    EXPECT_EQ(found.legs[leg].foot, figures_.legs[leg].foot) << leg;
    EXPECT_EQ(found.legs[leg].radius, figures_.legs[leg].radius) << leg;
    EXPECT_EQ(found.legs[leg].half_width, figures_.legs[leg].half_width) << leg;
  }
}

TEST_P(QuadrupedLegTest, MeasuresAFootThatIsNoBall) {
  const robot::RobotSpec& spec = config_.robots[0].spec;
  mjcf::ModelHandle model = mjcf::CopyOf(world_.model());
  const int geom = mj_name2id(model.get(), mjOBJ_GEOM, spec.feet[2].geoms[0].c_str());
  model->geom_type[geom] = mjGEOM_ELLIPSOID;
  mju_unit4(model->geom_quat + 4 * geom);
  std::ranges::copy(std::array{0.01, 0.02, 0.03}, model->geom_size + 3 * geom);
  const physics::MujocoWorld world(std::move(model), {{spec}});
  const LegFigures leg = ReadQuadruped(world.robot()).legs[2];
  EXPECT_NEAR(leg.radius, 0.03, 1e-9);
  EXPECT_NEAR(leg.half_width, spec.kind == robot::RobotKind::kWheeled ? 0.02 : 0, 1e-9);
}

TEST_P(QuadrupedLegTest, RefusesALegWithoutAFoot) {
  robot::RobotSpec spec = config_.robots[0].spec;
  spec.feet[1] = {.name = "tail", .geoms = {"none"}};
  const physics::MujocoWorld world(mjcf::CopyOf(world_.model()), {{spec}});
  EXPECT_THROW(ReadQuadruped(world.robot()), ModelError);
}

TEST_P(QuadrupedLegTest, WeighsWhatTheModelWeighs) {
  double mass = figures_.trunk.mass;
  for (const LegFigures& leg : figures_.legs) mass += QuadrupedLeg(leg).mass();
  EXPECT_NEAR(mass, figures_.mass, 1e-9);
  EXPECT_NEAR(mass * 9.81, robot_.weight(), 0.01);
}

TEST_P(QuadrupedLegTest, CentreOfMassIsTheModels) {
  const QuadrupedBody body(figures_);
  robot_.Reset(config_.robots[0].spec.standing);
  std::vector<robot::MotorReading> motors(robot_.q().size());
  for (std::size_t i = 0; i < motors.size(); ++i) motors[i].q = robot_.q()[i];
  const QuadrupedReading reading =
      body.Read({.motors = motors, .imu = robot_.Imu(), .foot_force = std::array<double, 4>{}});
  const int base = robot_.Body(config_.robots[0].spec.base_body);
  const Vector3d com(world_.data().subtree_com + 3 * base);
  EXPECT_LT((reading.com + robot_.base().p_WB - com).norm(), 1e-6);
}

TEST_P(QuadrupedLegTest, TouchesTheGroundWhereItsFootIsLowest) {
  const mjModel& model = world_.model();
  const int geom = mj_name2id(&model, mjOBJ_GEOM, config_.robots[0].spec.feet[0].geoms[0].c_str());
  const bool tyre = model.geom_type[geom] == mjGEOM_CYLINDER;
  const double radius = model.geom_size[3 * geom], half_width = model.geom_size[3 * geom + 1];
  const Vector3d up = Vector3d(0.02, 0, 1).normalized();
  for (const double hip : {-0.4, -0.1, 0.1, 0.4}) {
    robot::PoseSpec pose = config_.robots[0].spec.standing;
    pose.q[0] = hip;
    robot_.Reset(pose);
    const Matrix3d R = Eigen::Map<const Eigen::Matrix<mjtNum, 3, 3, Eigen::RowMajor>>(
        world_.data().geom_xmat + 9 * geom);
    double lowest = tyre ? 0 : -radius;
    for (int degree = 0; tyre && degree < 360; ++degree) {
      for (const double side : {-half_width, half_width}) {
        const double angle = degree * M_PI / 180;
        const Vector3d rim(radius * std::cos(angle), radius * std::sin(angle), side);
        lowest = std::min(lowest, up.dot(R * rim));
      }
    }
    const QuadrupedLeg leg(figures_.legs[0]);
    const Vector3d sole = leg.Sole(leg.Place({pose.q[0], pose.q[1], pose.q[2]}), up);
    EXPECT_NEAR(up.dot(sole), lowest, 1e-4) << hip;
    EXPECT_NEAR(sole.norm(), tyre ? std::hypot(radius, half_width) : radius, 1e-6) << hip;
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, QuadrupedLegTest, testing::ValuesIn(test::Quadrupeds()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace understudy::motion
