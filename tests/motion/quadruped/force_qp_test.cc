#include "motion/quadruped/force_qp.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

constexpr double kWeight = 150;  // N

ForceTask Standing() {
  ForceTask task{.force = {0, 0, kWeight}, .friction = 0.5, .weight = kWeight, .length = 0.4};
  task.arms = {Vector3d(0.2, -0.15, -0.3), Vector3d(0.2, 0.15, -0.3), Vector3d(-0.2, -0.15, -0.3),
               Vector3d(-0.2, 0.15, -0.3)};
  task.most.fill(2 * kWeight);
  task.last.fill({0, 0, kWeight / 4});
  return task;
}

Vector3d Sum(const PerLeg& forces) { return forces[0] + forces[1] + forces[2] + forces[3]; }

Vector3d Moment(const ForceTask& task, const PerLeg& forces) {
  Vector3d moment(0, 0, 0);
  for (std::size_t leg = 0; leg < 4; ++leg) moment += task.arms[leg].cross(forces[leg]);
  return moment;
}

TEST(ShareForcesTest, CarriesTheWeightEvenly) {
  for (const Vector3d& force : ShareForces(Standing())) {
    EXPECT_LT((force - Vector3d(0, 0, kWeight / 4)).norm(), 0.2);
  }
}

TEST(ShareForcesTest, DoesWhatItIsToldWhereItCan) {
  ForceTask task = Standing();
  task.force += Vector3d(20, -15, 10);
  task.moment = {2, -3, 1};
  PerLeg forces = task.last;
  for (int i = 0; i < 50; ++i) forces = task.last = ShareForces(task);  // changes are kept small
  EXPECT_LT((Sum(forces) - task.force).norm(), 1);
  EXPECT_LT((Moment(task, forces) - task.moment).norm(), 0.3);
}

TEST(ShareForcesTest, LeavesFeetInTheAirAlone) {
  ForceTask task = Standing();
  task.most[1] = task.most[2] = 0;
  const PerLeg forces = ShareForces(task);
  EXPECT_TRUE(forces[1].isZero(0));
  EXPECT_TRUE(forces[2].isZero(0));
  EXPECT_NEAR(Sum(forces).z(), kWeight, 2);
}

TEST(ShareForcesTest, AsksNothingOfARobotInTheAir) {
  ForceTask task = Standing();
  task.most.fill(0);
  for (const Vector3d& force : ShareForces(task)) EXPECT_TRUE(force.isZero(0));
}

// Whatever is asked for: the forces stay within their limits, and no small change within them does
// the task better.
TEST(ShareForcesTest, KeepsWithinFrictionAndLimitsWhateverIsAsked) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> any(-1, 1);
  const auto vector = [&](double size) {
    return Vector3d(size * any(random), size * any(random), size * any(random));
  };
  for (int i = 0; i < 500; ++i) {
    ForceTask task = Standing();
    task.force += vector(3 * kWeight);
    task.moment = vector(kWeight);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      task.arms[leg] += vector(0.1);
      task.least[leg] = 3;
      task.most[leg] = any(random) > 0.3 ? 0 : 100 + 50 * any(random);
    }
    const PerLeg forces = ShareForces(task);
    for (std::size_t leg = 0; leg < 4; ++leg) {
      if (task.most[leg] == 0) continue;
      EXPECT_GE(forces[leg].z(), task.least[leg] - 1e-4);
      EXPECT_LE(forces[leg].z(), task.most[leg] + 1e-4);
      for (int way = 0; way < 8; ++way) {
        const Vector3d side(std::cos(way * M_PI / 4), std::sin(way * M_PI / 4), 0);
        EXPECT_LE(side.dot(forces[leg]), task.friction * forces[leg].z() + 1e-4) << way;
      }
    }
  }
}

}  // namespace
}  // namespace understudy::motion
