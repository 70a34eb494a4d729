#include "motion/quadruped/force_qp.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include <Eigen/Cholesky>

namespace understudy::motion {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kMost = 12;  // forces' components
using Forces = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, kMost, 1>;
using Square = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, kMost, kMost>;

constexpr int kIterations = 40;
constexpr double kTolerance = 1e-9;  // of the weight
// unitree_guide's, but that the level forces count half of theirs: assumed.
constexpr double kLevelWeight = 10, kLiftWeight = 50, kTurnWeight = 82;
constexpr double kEffort = 0.01, kChange = 0.3;

// n' f >= b of the force f of one foot.
struct Limit {
  Eigen::Index at = 0;  // of the foot's first component
  Vector3d n{0, 0, 0};
  double b = 0;
};

// min 1/2 x' H x - g' x within the limits: begins at the free minimum and takes in one violated
// limit after the other, dropping those that would have to pull.
class DualActiveSet {
 public:
  DualActiveSet(const Square& H, const Forces& g)
      : inverse_(H.llt().solve(Square::Identity(H.rows(), H.rows()))), x_(inverse_ * g) {}

  template <class Limits>
  const Forces& Solve(const Limits& limits) {
    for (int i = 0; i < kIterations; ++i) {
      const Limit* worst = nullptr;
      double least = -kTolerance;
      for (const Limit& limit : limits) {
        const double slack = Slack(limit);
        if (slack < least) {
          least = slack;
          worst = &limit;
        }
      }
      if (worst == nullptr || !TakeIn(*worst)) break;
    }
    return x_;
  }

 private:
  double Slack(const Limit& limit) const { return limit.n.dot(x_.segment<3>(limit.at)) - limit.b; }
  Forces Moved(const Limit& limit) const { return inverse_.middleCols<3>(limit.at) * limit.n; }

  // Takes in a violated limit and drops those that stop it on the way; false: it cannot be kept.
  bool TakeIn(const Limit& limit) {
    constexpr double kNever = std::numeric_limits<double>::infinity();
    double pull = 0;  // of the limit that comes in
    for (int i = 0; i < kIterations; ++i) {
      Forces way = Moved(limit);
      const Forces gives = Given(&way);
      double partial = kNever;
      Eigen::Index leaves = -1;
      for (Eigen::Index j = 0; j < count_; ++j) {
        if (gives[j] <= 0 || pulls_[Size(j)] / gives[j] >= partial) continue;
        partial = pulls_[Size(j)] / gives[j];
        leaves = j;
      }
      const double gain = limit.n.dot(way.segment<3>(limit.at));
      const double full = gain > kTolerance && count_ < kMost ? -Slack(limit) / gain : kNever;
      const double step = std::min(partial, full);
      if (step == kNever) return false;
      for (Eigen::Index j = 0; j < count_; ++j) pulls_[Size(j)] -= step * gives[j];
      pull += step;
      if (full != kNever) x_ += step * way;
      if (full <= partial) {
        active_[Size(count_)] = limit;
        pulls_[Size(count_++)] = pull;
        return true;
      }
      --count_;
      active_[Size(leaves)] = active_[Size(count_)];
      pulls_[Size(leaves)] = pulls_[Size(count_)];
    }
    return false;
  }

  // How the pulls of the active limits change while one comes in that way; takes out of `way` what
  // they do not allow.
  Forces Given(Forces* way) const {
    Forces gives(count_);
    if (count_ == 0) return gives;
    Square between(count_, count_);
    for (Eigen::Index j = 0; j < count_; ++j) {
      const Limit& active = active_[Size(j)];
      gives[j] = active.n.dot(way->segment<3>(active.at));
      const Forces moved = Moved(active);
      for (Eigen::Index k = 0; k < count_; ++k) {
        between(k, j) = active_[Size(k)].n.dot(moved.segment<3>(active_[Size(k)].at));
      }
    }
    between.llt().solveInPlace(gives);
    for (Eigen::Index j = 0; j < count_; ++j) *way -= gives[j] * Moved(active_[Size(j)]);
    return gives;
  }

  static std::size_t Size(Eigen::Index i) { return static_cast<std::size_t>(i); }

  Square inverse_;
  Forces x_;
  std::array<Limit, kMost> active_;
  std::array<double, kMost> pulls_{};
  Eigen::Index count_ = 0;
};

}  // namespace

PerLeg ShareForces(const ForceTask& task) {
  std::array<std::size_t, 4> legs{};
  Eigen::Index feet = 0;
  for (std::size_t leg = 0; leg < 4; ++leg) {
    if (task.most[leg] > 0) legs[static_cast<std::size_t>(feet++)] = leg;
  }
  PerLeg forces;
  forces.fill(Vector3d::Zero());
  if (feet == 0) return forces;
  const Eigen::Matrix<double, 6, 1> weights{kLevelWeight, kLevelWeight, kLiftWeight,
                                            kTurnWeight,  kTurnWeight,  kTurnWeight};
  Eigen::Matrix<double, 6, Eigen::Dynamic, 0, 6, kMost> A(6, 3 * feet);
  Forces last(3 * feet);
  for (Eigen::Index i = 0; i < feet; ++i) {
    const std::size_t leg = legs[static_cast<std::size_t>(i)];
    const Vector3d arm = task.arms[leg] / task.length;
    A.block<3, 3>(0, 3 * i).setIdentity();
    A.block<3, 3>(3, 3 * i) << 0, -arm.z(), arm.y(), arm.z(), 0, -arm.x(), -arm.y(), arm.x(), 0;
    last.segment<3>(3 * i) = task.last[leg] / task.weight;
  }
  Eigen::Matrix<double, 6, 1> b;
  b << task.force / task.weight, task.moment / (task.weight * task.length);
  const Eigen::Matrix<double, Eigen::Dynamic, 6, 0, kMost, 6> AtS =
      A.transpose() * weights.asDiagonal();
  Square H = AtS * A;
  H.diagonal().array() += kEffort + kChange;
  DualActiveSet solver(H, AtS * b + kChange * last);
  // The sides of the friction cone, cut to a regular octagon: a square one would be steeper by two
  // fifths at its edges than on its sides, and feet slip where they are pushed aslant.
  constexpr double kAslant = std::numbers::sqrt2 / 2;
  using Sides = std::array<Vector3d, 8>;
  static const Sides kSides{Vector3d(1, 0, 0),  Vector3d(kAslant, kAslant, 0),
                            Vector3d(0, 1, 0),  Vector3d(-kAslant, kAslant, 0),
                            Vector3d(-1, 0, 0), Vector3d(-kAslant, -kAslant, 0),
                            Vector3d(0, -1, 0), Vector3d(kAslant, -kAslant, 0)};
  constexpr auto kLimits = static_cast<Eigen::Index>(std::tuple_size_v<Sides>) + 2;
  std::array<Limit, 4 * kLimits> limits;
  for (Eigen::Index i = 0; i < feet; ++i) {
    const std::size_t leg = legs[static_cast<std::size_t>(i)];
    Limit* at = &limits[static_cast<std::size_t>(kLimits * i)];
    for (const Vector3d& side : kSides) {
      *at++ = {3 * i, side + task.friction * Vector3d::UnitZ(), 0};
    }
    *at++ = {3 * i, Vector3d::UnitZ(), task.least[leg] / task.weight};
    *at = {3 * i, -Vector3d::UnitZ(), -task.most[leg] / task.weight};
  }
  const Forces x = solver.Solve(std::span(limits).first(static_cast<std::size_t>(kLimits * feet)));
  for (Eigen::Index i = 0; i < feet; ++i) {
    forces[legs[static_cast<std::size_t>(i)]] = task.weight * x.segment<3>(3 * i);
  }
  return forces;
}

}  // namespace understudy::motion
