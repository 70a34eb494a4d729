#include "identify/uncertainty.h"

#include <gtest/gtest.h>

#include "tests/identify/randomized_robot.h"
#include "tests/support/mujoco_test.h"

namespace understudy::identify {
namespace {

TEST(StudentQuantileTest, IsThatOfTheTables) {
  EXPECT_NEAR(StudentQuantile(0.95, 1), 12.706, 2e-3);
  EXPECT_NEAR(StudentQuantile(0.95, 5), 2.5706, 1e-4);
  EXPECT_NEAR(StudentQuantile(0.99, 10), 3.1693, 1e-4);
  EXPECT_NEAR(StudentQuantile(0.95, 30), 2.0423, 1e-4);
  EXPECT_NEAR(StudentQuantile(0.95, 5000), 1.9604, 1e-3);
}

class UncertaintyTest : public test::MujocoTest {
 protected:
  // Windows of one joint state after the first, all of whose residuals are of one size.
  Uncertainty Of(const std::vector<double>& slopes, const std::vector<double>& residuals) const {
    std::vector<ReplayWindow> windows(slopes.size(), ReplayWindow{.count = 2});
    const auto motors = static_cast<Eigen::Index>(replay_.motors());
    const auto rows = motors * static_cast<Eigen::Index>(slopes.size());
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(rows, 1);
    Eigen::VectorXd errors = Eigen::VectorXd::Zero(rows);
    for (std::size_t i = 0; i < slopes.size(); ++i) {
      jacobian(static_cast<Eigen::Index>(i) * motors, 0) = slopes[i];
      errors(static_cast<Eigen::Index>(i) * motors) = residuals[i];
    }
    return UncertaintyOf(replay_, windows, jacobian, errors);
  }

  Replay replay_ = ReplayOf(Known("go2"));
};

TEST_F(UncertaintyTest, IsTheSpreadOfWhatWindowsSay) {
  // Of n windows that tell a figure alike its variance is that of their residuals over n.
  const Uncertainty told = Of({1, 1, 1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1, 1, -1});
  EXPECT_NEAR(told.covariance(0, 0), 1.0 / 8 * 32 / 31, 1e-12);  // four limbs a window
  EXPECT_NEAR(told.freedom[0], 8.0 * 31 / 32, 1e-12);
}

TEST_F(UncertaintyTest, KnowsThatFewWindowsSayLittleOfTheSpread) {
  // One of eight windows tells nearly all: the error has nearly one degree of freedom.
  const Uncertainty told = Of({10, 1, 1, 1, 1, 1, 1, 1}, {1, -1, 1, -1, 1, -1, 1, -1});
  EXPECT_LT(told.freedom[0], 1.2);
  EXPECT_GT(StudentQuantile(0.95, told.freedom[0]), 9);
}

}  // namespace
}  // namespace understudy::identify
