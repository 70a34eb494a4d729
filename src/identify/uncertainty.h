// How certain fitted figures are.
#pragma once

#include <span>

#include <Eigen/Core>

#include "identify/replay.h"

namespace understudy::identify {

struct Uncertainty {
  Eigen::MatrixXd covariance{};  // of the figures
  Eigen::VectorXd freedom{};     // degrees of freedom of each variance in it, 1 at least
};

// From the residuals [rad] of windows, in the order of Replay::Run, and their slopes by the figures
// (docs/reference/identify.md, "What it does").
Uncertainty UncertaintyOf(const Replay& replay, std::span<const ReplayWindow> windows,
                          const Eigen::MatrixXd& slopes, const Eigen::VectorXd& residuals);

// Returns within how many standard errors Student's t lies with a probability from 0 to 1,
// exclusive, for degrees of freedom from 1 on.
double StudentQuantile(double probability, double freedom);

}  // namespace understudy::identify
