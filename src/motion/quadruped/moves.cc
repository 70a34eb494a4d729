#include "motion/quadruped/moves.h"

#include <algorithm>
#include <array>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// All assumed.
constexpr double kJointSpeed = 2.5;    // rad/s, mean of the fastest joint between two postures
constexpr double kShortestMove = 0.5;  // s
constexpr double kFeetTime = 1.2;      // s
constexpr double kLoading = 0.4;       // of that time: until the feet carry all

std::array<double, 12> Flat(const PerLeg& q) {
  std::array<double, 12> flat{};
  for (std::size_t i = 0; i < 12; ++i) flat[i] = q[i / 3][static_cast<Eigen::Index>(i % 3)];
  return flat;
}

}  // namespace

void JointsMove::Begin(const QuadrupedReading& sensed, const PerLeg& to, double duration) {
  move_.Begin(Flat(sensed.q), Flat(to), duration);
}

void JointsMove::Begin(const QuadrupedReading& sensed, const PerLeg& to) {
  double most = 0;
  for (std::size_t leg = 0; leg < to.size(); ++leg) {
    most = std::max(most, (to[leg] - sensed.q[leg]).cwiseAbs().maxCoeff());
  }
  Begin(sensed, to, std::max(most / kJointSpeed, kShortestMove));
}

void JointsMove::Step(const QuadrupedReading&, double dt, LegCommand* legs) {
  move_.Advance(dt);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto at = static_cast<Eigen::Index>(i % 3);
    legs->q[i / 3][at] = move_.q(i);
    legs->dq[i / 3][at] = move_.dq(i);
  }
  for (Vector3d& tau : legs->tau) tau.setZero();
}

void FeetMove::Begin(const QuadrupedReading& sensed, const PerLeg& to, Load load) {
  from_ = sensed.feet;
  to_ = to;
  load_ = load;
  elapsed_ = 0;
}

void FeetMove::Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) {
  elapsed_ += dt;
  const double part = elapsed_ / kFeetTime;
  const double s = SmoothStep(part);
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    feet[leg] = from_[leg] + s * (to_[leg] - from_[leg]);
  }
  legs->q = body_.Angles(feet);
  for (Vector3d& dq : legs->dq) dq.setZero();
  const double loaded = load_ == Load::kTaken ? part : 1 - part;
  legs->tau = body_.SupportTorque(sensed, {1, 1, 1, 1}, SmoothStep(loaded / kLoading));
}

bool FeetMove::over() const { return elapsed_ >= kFeetTime; }

}  // namespace understudy::motion
