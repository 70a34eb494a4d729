#include "identify/least_squares.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <spdlog/fmt/fmt.h>
#include <unsupported/Eigen/NonLinearOptimization>

namespace understudy::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kDelayStep = 0.001, kLongestDelay = 0.02;  // s, of the grid; *assumed*
constexpr std::size_t kGridWindows = 24;                    // enough to find its minima
constexpr std::size_t kMostStarts = 2;
constexpr int kMostSteps = 25;
constexpr double kSmallGain = 1e-5;  // of the sum of squares, at which a fit ends

// The value for a free variable x, which keeps it within its range, and its derivative.
struct Bounded {
  double value = 0, slope = 0;
};
Bounded Within(const FigureKind& quantity, double x) {
  const double share = 1 / (1 + std::exp(-x));
  const double slope = share * (1 - share);
  if (!quantity.ratio) {
    const double width = quantity.most - quantity.least;
    return {quantity.least + width * share, width * slope};
  }
  const double span = std::log(quantity.most / quantity.least);
  const double value = quantity.least * std::exp(span * share);
  return {value, value * span * slope};
}
double FreeOf(const FigureKind& quantity, double value) {
  const double share = quantity.ratio ? std::log(std::max(value, quantity.least) / quantity.least) /
                                            std::log(quantity.most / quantity.least)
                                      : (value - quantity.least) / (quantity.most - quantity.least);
  const double inside = std::clamp(share, 0.01, 0.99);
  return std::log(inside / (1 - inside));
}

// Sets of parameters that move different limbs: one simulation tells the slopes of all of a set.
std::vector<std::vector<std::size_t>> Together(std::span<const Parameter> parameters) {
  std::vector<std::vector<std::size_t>> sets;
  const auto apart = [&](std::size_t a, std::size_t b) {
    const auto& of_a = parameters[a].limbs;
    const auto& of_b = parameters[b].limbs;
    return !of_a.empty() && !of_b.empty() && std::ranges::none_of(of_a, [&](std::size_t limb) {
      return std::ranges::count(of_b, limb) > 0;
    });
  };
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const auto fits = std::ranges::find_if(sets, [&](const auto& set) {
      return std::ranges::all_of(set, [&](std::size_t other) { return apart(i, other); });
    });
    if (fits == sets.end()) {
      sets.push_back({i});
    } else {
      fits->push_back(i);
    }
  }
  return sets;
}

// Levenberg-Marquardt from x, at most kMostSteps steps. Reports each. Returns the rms, or
// nullopt if a signal asked to stop.
std::optional<double> Solve(Problem* problem, VectorXd* x,
                            const std::function<void(int step)>& told) {
  Eigen::LevenbergMarquardt<Problem> solver(*problem);
  solver.parameters.ftol = kSmallGain;
  solver.parameters.xtol = 1e-6;
  solver.parameters.factor = 1;  // free variables are of order 1
  namespace Status = Eigen::LevenbergMarquardtSpace;
  Status::Status status = solver.minimizeInit(*x);
  for (int i = 0; i < kMostSteps && status != Status::UserAsked; ++i) {
    status = solver.minimizeOneStep(*x);
    told(i + 1);
    if (status != Status::Running) break;
  }
  if (status == Status::UserAsked) return std::nullopt;
  return solver.fnorm / std::sqrt(static_cast<double>(problem->count));
}

}  // namespace

std::vector<double> Problem::Values(const VectorXd& x) const {
  std::vector<double> values;
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    values.push_back(Within(*parameters[i].quantity, x[static_cast<Index>(i)]).value);
  }
  return values;
}

int Problem::operator()(const VectorXd& x, VectorXd& residuals) const {
  const Figures figures = basis.With(parameters, Values(x));
  residuals.resize(count);
  double* const out = residuals.data();
  return replay.Run({&figures, 1}, windows, {&out, 1}) ? 0 : -1;
}

int Problem::df(const VectorXd& x, MatrixXd& slopes) const {
  if (!Slopes(Values(x), &slopes)) return -1;
  for (Index i = 0; i < x.size(); ++i) {
    slopes.col(i) *= Within(*parameters[static_cast<std::size_t>(i)].quantity, x[i]).slope;
  }
  return 0;
}

bool Problem::Slopes(const std::vector<double>& at, MatrixXd* slopes) const {
  const auto sets = Together(parameters);
  std::vector<double> reach;
  for (std::size_t i = 0; i < at.size(); ++i) {
    reach.push_back(parameters[i].quantity->ratio ? 1e-3 * at[i] : 1e-4);
  }
  slopes->setZero(count, static_cast<Index>(at.size()));
  VectorXd up(count), down(count);
  for (const auto& set : sets) {
    std::vector<double> above = at, below = at;
    for (const std::size_t i : set) {
      above[i] += reach[i];
      below[i] -= reach[i];
    }
    const Figures figures[] = {basis.With(parameters, above), basis.With(parameters, below)};
    double* const out[] = {up.data(), down.data()};
    if (!replay.Run(figures, windows, out)) return false;
    for (const std::size_t i : set) {
      const auto& limbs = parameters[i].limbs;
      const auto motors = static_cast<Index>(replay.motors());
      for (Index row = 0; row < count; ++row) {
        const std::size_t limb = replay.bench().limb(static_cast<std::size_t>(row % motors));
        if (!limbs.empty() && std::ranges::count(limbs, limb) == 0) continue;
        (*slopes)(row, static_cast<Index>(i)) = (up[row] - down[row]) / (2 * reach[i]);
      }
    }
  }
  return true;
}

double Rms(const VectorXd& residuals) {
  return residuals.size() == 0
             ? 0
             : std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

std::optional<std::vector<VectorXd>> StartsOf(const Problem& problem) {
  VectorXd x(problem.inputs());
  Index delay = -1;
  for (Index i = 0; i < x.size(); ++i) {
    const Parameter& parameter = problem.parameters[static_cast<std::size_t>(i)];
    x[i] = FreeOf(*parameter.quantity, parameter.before);
    if (parameter.group == Parameter::kAll) delay = i;
  }
  if (delay < 0) return std::vector<VectorXd>{x};
  std::vector<ReplayWindow> some;
  const std::size_t by = (problem.windows.size() + kGridWindows - 1) / kGridWindows;
  for (std::size_t i = 0; i < problem.windows.size(); i += by) some.push_back(problem.windows[i]);
  Problem coarse{.replay = problem.replay,
                 .basis = problem.basis,
                 .parameters = problem.parameters,
                 .windows = some};
  std::vector<std::pair<double, double>> grid;  // rms, delay
  for (int i = 0; i * kDelayStep <= kLongestDelay + 1e-9; ++i) {
    VectorXd residuals;
    const FigureKind& quantity = *problem.parameters[static_cast<std::size_t>(delay)].quantity;
    x[delay] = FreeOf(quantity, i * kDelayStep);
    if (coarse(x, residuals) < 0) return std::nullopt;
    grid.emplace_back(Rms(residuals), x[delay]);
  }
  std::vector<std::pair<double, double>> minima;
  for (std::size_t i = 0; i < grid.size(); ++i) {
    const bool left = i == 0 || grid[i].first <= grid[i - 1].first;
    const bool right = i + 1 == grid.size() || grid[i].first < grid[i + 1].first;
    if (left && right) minima.push_back(grid[i]);
  }
  std::ranges::sort(minima);
  if (minima.size() > kMostStarts) minima.resize(kMostStarts);
  std::vector<VectorXd> starts;
  for (const auto& [rms, at] : minima) {
    starts.push_back(x);
    starts.back()[delay] = at;
  }
  return starts;
}

std::optional<VectorXd> BestFrom(const std::vector<VectorXd>& starts, Problem* problem,
                                 const FitTold& told) {
  VectorXd best;
  double least = 0;
  const int most = static_cast<int>(starts.size()) * kMostSteps;
  int before = 0;
  for (VectorXd x : starts) {
    const std::optional<double> rms =
        Solve(problem, &x, [&](int step) { told.progress(before + step, most); });
    if (!rms) return std::nullopt;
    before += kMostSteps;
    told.line(fmt::format("rms of q {:.5f} rad", *rms));
    if (best.size() == 0 || *rms < least) {
      least = *rms;
      best = x;
    }
  }
  return best;
}

}  // namespace understudy::identify
