// Fits figures of joints to windows of recordings by least squares.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "identify/fit_told.h"
#include "identify/parameters.h"
#include "identify/replay.h"

namespace understudy::identify {

// The differences of simulated and recorded angles [rad] as a function of free variables, as
// Eigen's Levenberg-Marquardt takes it. Each variable stands for a parameter and keeps it within
// its range.
struct Problem {
  using Scalar = double;
  using InputType = Eigen::VectorXd;
  using ValueType = Eigen::VectorXd;
  using JacobianType = Eigen::MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Replay& replay;
  const Basis& basis;
  std::vector<Parameter> parameters;
  std::span<const ReplayWindow> windows;
  Eigen::Index count = replay.ResidualsOf(windows);

  int inputs() const { return static_cast<int>(parameters.size()); }
  int values() const { return static_cast<int>(count); }
  // Those of the parameters.
  std::vector<double> Values(const Eigen::VectorXd& x) const;

  // Below 0 asks the solver to stop.
  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const;
  // Slopes by the free variables; below 0 asks the solver to stop.
  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& slopes) const;
  // Slopes by the values themselves, of central differences. Returns false if a signal asked to
  // stop.
  bool Slopes(const std::vector<double>& at, Eigen::MatrixXd* slopes) const;
};

// Returns where to begin: as before, but for the delay, of which a grid tells the lowest minima.
// Returns nullopt if a signal asked to stop.
std::optional<std::vector<Eigen::VectorXd>> StartsOf(const Problem& problem);

// Returns the best of the fits from each of these; tells the error of each. Returns nullopt if a
// signal asked to stop.
std::optional<Eigen::VectorXd> BestFrom(const std::vector<Eigen::VectorXd>& starts,
                                        Problem* problem, const FitTold& told);

// Returns the root mean square, 0 of nothing.
double Rms(const Eigen::VectorXd& residuals);

}  // namespace understudy::identify
