#include "identify/identify.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

#include <Eigen/Eigenvalues>
#include <spdlog/fmt/fmt.h>

#include "base/errors.h"
#include "identify/least_squares.h"
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
// cannot be determined by finite differences.
constexpr double kSingular = 1e-7;

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

VectorXd Without(const VectorXd& x, const std::vector<std::size_t>& left_out) {
  std::vector<double> others;
  for (Index i = 0; i < x.size(); ++i) {
    if (std::ranges::count(left_out, static_cast<std::size_t>(i)) == 0) others.push_back(x[i]);
  }
  return Eigen::Map<const VectorXd>(others.data(), static_cast<Index>(others.size()));
}

// Which parameters can be determined, and which cannot and why.
struct Telling {
  std::vector<Parameter> kept;
  std::vector<Found> refused;
};

// Takes `at` out of `kept`. `why` says why it cannot be determined.
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

// Those whose standard errors are too large, the worst first, but for those that may become
// certain once a correlated one is refused.
std::vector<std::size_t> TooUncertain(const std::vector<Parameter>& parameters,
                                      const std::vector<double>& values,
                                      const MatrixXd& covariance) {
  std::vector<std::pair<double, std::size_t>> over;  // how often the allowed error
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FigureKind& quantity = *parameters[i].quantity;
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
  std::vector<ReplayWindow> fitted, held_out;
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
    for (ReplayWindow& window : WindowsOf(samples, options.window, timestep)) {
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
                              std::span<const ReplayWindow> windows) {
  VectorXd residuals(replay.ResidualsOf(windows));
  double* const out = residuals.data();
  if (!replay.Run({&figures, 1}, windows, {&out, 1})) return std::nullopt;
  return Rms(residuals);
}

}  // namespace

std::optional<Identification> Identify(const Replay& replay, const Basis& basis,
                                       std::span<const Samples> recordings,
                                       std::span<const Samples> held_out, const Options& options,
                                       const FitTold& told) {
  const Split split = SplitOf(recordings, held_out, options, replay.timestep());
  Telling telling{.kept = basis.Parameters(options.parameters, replay.bench()), .refused = {}};
  const Figures before = basis.With({}, {});
  Identification result{.window = options.window};
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
      const std::optional<std::vector<VectorXd>> found = StartsOf(problem);
      if (!found) return std::nullopt;
      told.line(fmt::format("{} figures, {} windows", problem.inputs(), split.fitted.size()));
      starts = *found;
    }
    // A direction that cannot be determined is found before anything is fitted.
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
      told.line("cannot tell " + telling.refused.back().name);
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
