// What the solver does where a joint cannot give what its solution needs.
#include "motion/humanoid/walk_solver.h"

#include <cmath>
#include <vector>

#include "tests/motion/humanoid/fixture.h"
#include "tests/support/robots.h"

namespace understudy::motion {
namespace {

// On its left foot, in its standing pose and at rest.
class WalkSolverTest : public test::MujocoTest, public testing::WithParamInterface<std::string> {
 protected:
  WalkSolverTest() {
    rig_.Start("standing");
    const physics::RobotBody& robot = rig_.world().robot();
    const std::vector<double> still(motors_);
    body_.Update(rig_.spec().standing.q, still, robot.Imu());
    task_.lift = 0;
  }

  // N·m, in motor order.
  std::vector<double> Torques(const Eigen::Vector3d& turn) {
    std::vector<double> tau(motors_);
    const std::vector<double> still(motors_);
    task_.turn = turn;
    EXPECT_TRUE(solver_.Solve(task_, rig_.spec().standing.q, still, tau));
    return tau;
  }

  HumanoidRig rig_{GetParam()};
  std::size_t motors_ = rig_.spec().motors.size();
  BodyModel soles_{rig_.world().robot().nominal(), rig_.spec()};
  WalkBody body_{rig_.world().robot().nominal(), rig_.spec(), soles_};
  WalkSolver solver_{body_};
  WalkTask task_;
};

TEST_P(WalkSolverTest, AStanceHipIsAskedForNoMoreThanItGives) {
  const WalkBody::Foot& stance = body_.feet()[0];
  for (const double fast : {-150.0, 150.0}) {  // rad/s²
    for (const int axis : {0, 1}) {
      const std::vector<double> tau = Torques(fast * Eigen::Vector3d::Unit(axis));
      for (const int hip : {stance.hip_pitch, stance.hip_roll}) {
        const auto motor = static_cast<std::size_t>(hip);
        EXPECT_LT(std::abs(tau[motor]), rig_.spec().motors[motor].torque_limit)
            << fast << " about " << axis << ", " << rig_.spec().motors[motor].joint;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Robots, WalkSolverTest, testing::ValuesIn(test::Humanoids()),
                         [](const auto& robot) { return robot.param; });

}  // namespace
}  // namespace understudy::motion
