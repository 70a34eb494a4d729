#include "identify/identify.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <spdlog/fmt/fmt.h>
#include <unsupported/Eigen/NonLinearOptimization>

#include "base/errors.h"
#include "identify/uncertainty.h"

namespace understudy::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr std::size_t kLeastWindows = 10;
constexpr double kHighCorrelation = 0.9;
constexpr double kApart = 0.3;  // a correlation below it: one says little of the other; *assumed*
// Of the least to the largest eigenvalue of the normalised normal matrix, below which a direction
// cannot be told by finite differences.
constexpr double kSingular = 1e-7;
constexpr double kDelayStep = 0.001, kLongestDelay = 0.02;  // s, of the grid; *assumed*
constexpr std::size_t kGridWindows = 24;                    // enough to find its minima
constexpr std::size_t kMostStarts = 2;
constexpr int kMostSteps = 25;
constexpr double kSmallGain = 1e-5;  // of the sum of squares, at which a fit ends

// The value for a free variable x, which keeps it within its range, and its derivative.
struct Bounded {
  double value = 0, slope = 0;
};
Bounded Within(const Quantity& quantity, double x) {
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
double FreeOf(const Quantity& quantity, double value) {
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

// The differences of simulated and recorded angles as a function of the free variables, as Eigen's
// Levenberg-Marquardt takes it.
struct Problem {
  using Scalar = double;
  using InputType = VectorXd;
  using ValueType = VectorXd;
  using JacobianType = MatrixXd;
  enum { InputsAtCompileTime = Eigen::Dynamic, ValuesAtCompileTime = Eigen::Dynamic };

  const Replay& replay;
  const Basis& basis;
  std::vector<Parameter> parameters;
  std::span<const Window> windows;
  Index count = replay.ResidualsOf(windows);

  int inputs() const { return static_cast<int>(parameters.size()); }
  int values() const { return static_cast<int>(count); }

  std::vector<double> Values(const VectorXd& x) const {
    std::vector<double> values;
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      values.push_back(Within(*parameters[i].quantity, x[static_cast<Index>(i)]).value);
    }
    return values;
  }

  // Below 0 asks the solver to stop.
  int operator()(const VectorXd& x, VectorXd& residuals) const {
    const Figures figures = basis.With(parameters, Values(x));
    residuals.resize(count);
    double* const out = residuals.data();
    return replay.Run({&figures, 1}, windows, {&out, 1}) ? 0 : -1;
  }

  // Of the free variables.
  int df(const VectorXd& x, MatrixXd& slopes) const {
    if (!Slopes(Values(x), &slopes)) return -1;
    for (Index i = 0; i < x.size(); ++i) {
      slopes.col(i) *= Within(*parameters[static_cast<std::size_t>(i)].quantity, x[i]).slope;
    }
    return 0;
  }

  // Central differences by the values themselves. Returns false if a signal asked to stop.
  bool Slopes(const std::vector<double>& at, MatrixXd* slopes) const {
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
};

double Rms(const VectorXd& residuals) {
  return residuals.size() == 0
             ? 0
             : std::sqrt(residuals.squaredNorm() / static_cast<double>(residuals.size()));
}

// Levenberg-Marquardt from x. Returns the rms, or nullopt if a signal asked to stop.
std::optional<double> Solve(Problem* problem, VectorXd* x) {
  Eigen::LevenbergMarquardt<Problem> solver(*problem);
  solver.parameters.ftol = kSmallGain;
  solver.parameters.xtol = 1e-6;
  solver.parameters.factor = 1;  // free variables are of order 1
  namespace Status = Eigen::LevenbergMarquardtSpace;
  Status::Status status = solver.minimizeInit(*x);
  for (int i = 0; i < kMostSteps && status != Status::UserAsked; ++i) {
    status = solver.minimizeOneStep(*x);
    if (status != Status::Running) break;
  }
  if (status == Status::UserAsked) return std::nullopt;
  return solver.fnorm / std::sqrt(static_cast<double>(problem->count));
}

// The parameters of a direction along which nothing changes; empty if there is none.
std::vector<std::size_t> SingularDirection(const MatrixXd& slopes) {
  const VectorXd norms = slopes.colwise().norm();
  const double largest = norms.maxCoeff();
  for (Index i = 0; i < norms.size(); ++i) {
    if (norms[i] == 0 || !std::isfinite(largest)) return {static_cast<std::size_t>(i)};
  }
  const MatrixXd scaled = slopes * norms.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatrixXd> eigen(scaled.transpose() * scaled);
  const VectorXd& values = eigen.eigenvalues();
  if (values[0] > kSingular * values[values.size() - 1]) return {};
  std::vector<std::size_t> parts;
  for (Index i = 0; i < norms.size(); ++i) {
    if (std::abs(eigen.eigenvectors()(i, 0)) > 0.1) parts.push_back(static_cast<std::size_t>(i));
  }
  return parts;
}

// The best of the fits from each of these. Returns nullopt if a signal asked to stop.
std::optional<VectorXd> BestFrom(const std::vector<VectorXd>& starts, Problem* problem,
                                 const std::function<void(const std::string&)>& told) {
  VectorXd best;
  double least = 0;
  for (VectorXd x : starts) {
    const std::optional<double> rms = Solve(problem, &x);
    if (!rms) return std::nullopt;
    told(fmt::format("rms of q {:.5f} rad", *rms));
    if (best.size() == 0 || *rms < least) {
      least = *rms;
      best = x;
    }
  }
  return best;
}

VectorXd Without(const VectorXd& x, const std::vector<std::size_t>& left_out) {
  std::vector<double> others;
  for (Index i = 0; i < x.size(); ++i) {
    if (std::ranges::count(left_out, static_cast<std::size_t>(i)) == 0) others.push_back(x[i]);
  }
  return Eigen::Map<const VectorXd>(others.data(), static_cast<Index>(others.size()));
}

// Where to begin: as before, but for the delay, of which the grid tells the lowest minima.
std::optional<std::vector<VectorXd>> Starts(const Problem& problem) {
  VectorXd x(problem.inputs());
  Index delay = -1;
  for (Index i = 0; i < x.size(); ++i) {
    const Parameter& parameter = problem.parameters[static_cast<std::size_t>(i)];
    x[i] = FreeOf(*parameter.quantity, parameter.before);
    if (parameter.group == Parameter::kAll) delay = i;
  }
  if (delay < 0) return std::vector<VectorXd>{x};
  std::vector<Window> some;
  const std::size_t by = (problem.windows.size() + kGridWindows - 1) / kGridWindows;
  for (std::size_t i = 0; i < problem.windows.size(); i += by) some.push_back(problem.windows[i]);
  Problem coarse{.replay = problem.replay,
                 .basis = problem.basis,
                 .parameters = problem.parameters,
                 .windows = some};
  std::vector<std::pair<double, double>> grid;  // rms, delay
  for (int i = 0; i * kDelayStep <= kLongestDelay + 1e-9; ++i) {
    VectorXd residuals;
    const Quantity& quantity = *problem.parameters[static_cast<std::size_t>(delay)].quantity;
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

// What of the parameters can be told, and what not and why.
struct Telling {
  std::vector<Parameter> kept;
  std::vector<Found> refused;
};

// Takes `at` out of `kept`. `why` says why it cannot be told.
void Refuse(const Basis& basis, std::size_t at, const std::string& why, Telling* telling) {
  const Parameter& refused = telling->kept[at];
  telling->refused.push_back(
      {.parameter = refused,
       .name = basis.NameOf(refused),
       .told = false,
       .value = refused.before,
       .error = 0,
       .why = why + "; to tell it, " + std::string(refused.quantity->excite)});
  telling->kept.erase(telling->kept.begin() + static_cast<std::ptrdiff_t>(at));
}

// Refuses one of those along which nothing changes: one that is not usually fitted, if there is
// one.
void RefuseOneOf(const std::vector<std::size_t>& singular, const Basis& basis, Telling* telling) {
  std::size_t worst = singular.back();
  for (const std::size_t i : singular) {
    if (!telling->kept[i].quantity->usual) worst = i;
  }
  std::string others;
  for (const std::size_t i : singular) {
    if (i != worst) others += (others.empty() ? "" : ", ") + basis.NameOf(telling->kept[i]);
  }
  Refuse(basis, worst,
         others.empty() ? "nothing that was recorded depends on it"
                        : "the data cannot tell it from " + others,
         telling);
}

double Correlation(const MatrixXd& covariance, Index a, Index b) {
  return covariance(a, b) / std::sqrt(covariance(a, a) * covariance(b, b));
}

// Those whose standard errors are too large, the worst first, but for those that may be told once
// another one that hangs together with them is refused.
std::vector<std::size_t> TooUncertain(const std::vector<Parameter>& parameters,
                                      const std::vector<double>& values,
                                      const MatrixXd& covariance) {
  std::vector<std::pair<double, std::size_t>> over;  // how often the allowed error
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const Quantity& quantity = *parameters[i].quantity;
    const auto at = static_cast<Index>(i);
    const double error = std::sqrt(std::max(0.0, covariance(at, at)));
    const double times = error / (quantity.tell * (quantity.ratio ? values[i] : 1));
    if (times > 1) over.emplace_back(-times, i);
  }
  std::ranges::sort(over);
  std::vector<std::size_t> chosen;
  for (const auto& [times, i] : over) {
    const auto apart = [&, i = static_cast<Index>(i)](std::size_t other) {
      return std::abs(Correlation(covariance, i, static_cast<Index>(other))) < kApart;
    };
    if (std::ranges::all_of(chosen, apart)) chosen.push_back(i);
  }
  return chosen;
}

struct Split {
  std::vector<Window> fitted, held_out;
};

Split SplitOf(std::span<const Samples> recordings, std::span<const Samples> held_out,
              const Options& options, double timestep) {
  Split split;
  for (const Samples& samples : held_out) {
    std::ranges::copy(WindowsOf(samples, options.window, timestep),
                      std::back_inserter(split.held_out));
  }
  double due = 0;
  for (const Samples& samples : recordings) {
    for (Window& window : WindowsOf(samples, options.window, timestep)) {
      due += held_out.empty() ? options.hold_out : 0;
      (due >= 1 ? split.held_out : split.fitted).push_back(std::move(window));
      if (due >= 1) due -= 1;
    }
  }
  if (split.fitted.size() < kLeastWindows) {
    throw RecordError(
        fmt::format("{}: {} windows of {} s to fit to, expected {} or more: record for longer",
                    recordings.front().file, split.fitted.size(), options.window, kLeastWindows));
  }
  return split;
}

// The rms with these figures, of all windows.
std::optional<double> RmsWith(const Replay& replay, const Figures& figures,
                              std::span<const Window> windows) {
  VectorXd residuals(replay.ResidualsOf(windows));
  double* const out = residuals.data();
  if (!replay.Run({&figures, 1}, windows, {&out, 1})) return std::nullopt;
  return Rms(residuals);
}

}  // namespace

std::optional<Result> Identify(const Replay& replay, const Basis& basis,
                               std::span<const Samples> recordings,
                               std::span<const Samples> held_out, const Options& options,
                               const std::function<void(const std::string&)>& told) {
  const Split split = SplitOf(recordings, held_out, options, replay.timestep());
  Telling telling{.kept = basis.Parameters(options.parameters, replay.bench()), .refused = {}};
  const Figures before = basis.With({}, {});
  Result result{.window = options.window};
  result.fitted.windows = split.fitted.size();
  result.held_out.windows = split.held_out.size();

  std::vector<double> values;
  Uncertainty uncertainty;
  const MatrixXd& covariance = uncertainty.covariance;
  std::vector<VectorXd> starts;
  while (!telling.kept.empty()) {
    Problem problem{
        .replay = replay, .basis = basis, .parameters = telling.kept, .windows = split.fitted};
    if (starts.empty()) {
      const std::optional<std::vector<VectorXd>> found = Starts(problem);
      if (!found) return std::nullopt;
      told(fmt::format("{} figures, {} windows", problem.inputs(), split.fitted.size()));
      starts = *found;
    }
    // A direction that cannot be told is found before anything is fitted.
    MatrixXd slopes;
    if (!problem.Slopes(problem.Values(starts.front()), &slopes)) return std::nullopt;
    if (const auto singular = SingularDirection(slopes); !singular.empty()) {
      RefuseOneOf(singular, basis, &telling);
      starts.clear();
      continue;
    }
    const std::optional<VectorXd> best = BestFrom(starts, &problem, told);
    if (!best) return std::nullopt;
    values = problem.Values(*best);
    VectorXd residuals;
    if (problem(*best, residuals) < 0 || !problem.Slopes(values, &slopes)) return std::nullopt;
    if (const auto singular = SingularDirection(slopes); !singular.empty()) {
      RefuseOneOf(singular, basis, &telling);
      starts.clear();
      continue;
    }
    uncertainty = UncertaintyOf(replay, split.fitted, slopes, residuals);
    std::vector<std::size_t> refused = TooUncertain(telling.kept, values, covariance);
    if (refused.empty()) break;
    // The others go on from where they are.
    starts = {Without(*best, refused)};
    std::ranges::sort(refused, std::greater<>());
    for (const std::size_t i : refused) {
      const double error = std::sqrt(covariance(static_cast<Index>(i), static_cast<Index>(i)));
      Refuse(basis, i, fmt::format("its standard error would be {:.2g}", error), &telling);
      told("cannot tell " + telling.refused.back().name);
    }
  }
  if (telling.kept.empty()) values.clear();

  for (std::size_t i = 0; i < telling.kept.size(); ++i) {
    const auto at = static_cast<Index>(i);
    result.found.push_back({.parameter = telling.kept[i],
                            .name = basis.NameOf(telling.kept[i]),
                            .value = values[i],
                            .error = std::sqrt(std::max(0.0, covariance(at, at))),
                            .freedom = uncertainty.freedom[at]});
    for (Index other = 0; other < at; ++other) {
      const double by = Correlation(covariance, at, other);
      if (std::abs(by) <= kHighCorrelation) continue;
      result.correlated.push_back({.first = result.found[static_cast<std::size_t>(other)].name,
                                   .second = result.found.back().name,
                                   .by = by});
    }
  }
  std::ranges::move(telling.refused, std::back_inserter(result.found));
  const Figures after = basis.With(telling.kept, values);
  for (const auto& [windows, fit] : {std::pair(std::span(split.fitted), &result.fitted),
                                     std::pair(std::span(split.held_out), &result.held_out)}) {
    const auto was = RmsWith(replay, before, windows), is = RmsWith(replay, after, windows);
    if (!was || !is) return std::nullopt;
    fit->before = *was;
    fit->after = *is;
  }
  return result;
}

}  // namespace understudy::identify
