#include "identify/uncertainty.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Cholesky>

namespace understudy::identify {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

}  // namespace

Uncertainty UncertaintyOf(const Replay& replay, std::span<const ReplayWindow> windows,
                          const MatrixXd& slopes, const VectorXd& residuals) {
  const Index p = slopes.cols();
  const auto motors = static_cast<Index>(replay.motors());
  std::size_t limbs = 0;
  for (std::size_t i = 0; i < replay.motors(); ++i) {
    limbs = std::max(limbs, replay.bench().limb(i) + 1);
  }
  // Scaled, since values are of very different size.
  const VectorXd norms = slopes.colwise().norm().cwiseMax(1e-300);
  const MatrixXd scaled = slopes * norms.cwiseInverse().asDiagonal();
  const MatrixXd bread = (scaled.transpose() * scaled).ldlt().solve(MatrixXd::Identity(p, p));
  // Residuals of one limb within a window hang together, since one error of its start moves all of
  // them, and count as one observation.
  MatrixXd meat = MatrixXd::Zero(p, p);
  VectorXd shares = VectorXd::Zero(p), squares = VectorXd::Zero(p);
  double clusters = 0;
  Index begin = 0;
  for (const ReplayWindow& window : windows) {
    const Index end = begin + static_cast<Index>(window.count - 1) * motors;
    for (std::size_t limb = 0; limb < limbs; ++limb) {
      VectorXd score = VectorXd::Zero(p), share = VectorXd::Zero(p);
      for (Index row = begin; row < end; ++row) {
        if (replay.bench().limb(static_cast<std::size_t>(row % motors)) != limb) continue;
        score += residuals[row] * scaled.row(row).transpose();
        share += (bread * scaled.row(row).transpose()).cwiseAbs2();
      }
      meat += score * score.transpose();
      shares += share;
      squares += share.cwiseAbs2();
      clusters += 1;
    }
    begin = end;
  }
  const double few = clusters / std::max(1.0, clusters - static_cast<double>(p));
  const VectorXd back = norms.cwiseInverse();
  // Satterthwaite: of a sum of squares, each of its share of the variance.
  const VectorXd freedom = shares.cwiseAbs2().cwiseQuotient(squares.cwiseMax(1e-300)) / few;
  return {.covariance = back.asDiagonal() * (few * bread * meat * bread) * back.asDiagonal(),
          .freedom = freedom.cwiseMax(1)};
}

double StudentQuantile(double probability, double freedom) {
  // With t = √ν tan φ the density is that of cos^(ν-1) φ, from 0 to π/2.
  constexpr std::size_t kParts = 4000;
  constexpr double kPart = std::numbers::pi / 2 / kParts;
  std::array<double, kParts + 1> below{};
  const auto density = [&](double at) { return std::pow(std::cos(at), freedom - 1); };
  for (std::size_t i = 0; i < kParts; ++i) {
    below[i + 1] = below[i] + kPart * density((static_cast<double>(i) + 0.5) * kPart);
  }
  const double sought = probability * below[kParts];
  const auto after = std::ranges::upper_bound(below, sought);
  const auto i = static_cast<std::size_t>(after - below.begin()) - 1;
  const double share = (sought - below[i]) / (below[i + 1] - below[i]);
  return std::sqrt(freedom) * std::tan((static_cast<double>(i) + share) * kPart);
}

}  // namespace understudy::identify
