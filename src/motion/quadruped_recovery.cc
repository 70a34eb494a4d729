#include "motion/quadruped_recovery.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace understudy {
namespace {

using Eigen::Vector3d;

double Env(const char* n, double d) { const char* v = std::getenv(n); return v ? std::atof(v) : d; }

constexpr double kUpright = 0.8;  // cosine of the tilt from which legs alone lift the robot
constexpr double kOnBack = -0.6;

bool IsRight(std::size_t leg) { return leg % 2 == 0; }

std::array<double, 12> Flat(const PerLeg& q) {
  std::array<double, 12> flat{};
  for (std::size_t i = 0; i < 12; ++i) flat[i] = q[i / 3][static_cast<Eigen::Index>(i % 3)];
  return flat;
}

}  // namespace

QuadrupedRecovery::QuadrupedRecovery(const QuadrupedBody& body) : body_(body), move_(12) {}

void QuadrupedRecovery::Begin(const QuadrupedReading& reading) {
  attempts_ = 0;
  Enter(Phase::kFold, reading);
}

PerLeg QuadrupedRecovery::Goal(Phase phase) const {
  PerLeg goal;
  for (std::size_t leg = 0; leg < goal.size(); ++leg) {
    const LegFigures& figures = body_.leg(leg).figures();
    const double out = IsRight(leg) ? -1 : 1;  // sign of a hip angle that spreads the leg
    const bool lower = IsRight(leg) == right_down_;
    Vector3d q(0, 1.3, figures.low[2] + 0.05);
    if (phase == Phase::kFromBack && !lower) {
      q = Vector3d(out * Env("BH", 0.3), Env("BT", 3.1), Env("BC", -1.5));
    } else if (phase == Phase::kFromSide) {
      if (lower) {
        q = Vector3d(out * Env("SH", 1.0), Env("ST", 1.3), Env("SC", -2.6));
      } else {
        q = Vector3d(out * Env("UH", 0.8), Env("UT", 1.3), Env("UC", -2.6));
      }
    }
    for (int i = 0; i < 3; ++i) {
      const auto at = static_cast<std::size_t>(i);
      goal[leg][i] = std::clamp(q[i], figures.low[at] + 0.03, figures.high[at] - 0.03);
    }
  }
  return goal;
}

void QuadrupedRecovery::Enter(Phase phase, const QuadrupedReading& reading) {
  phase_ = phase;
  if (phase == Phase::kOver) return;
  if (phase != Phase::kFold) ++attempts_;
  const double duration = phase == Phase::kFold ? 0.8 : phase == Phase::kFromBack ? Env("BD", 0.4) : Env("SD", 0.3);
  left_ = duration + 0.6;
  move_.Begin(Flat(reading.q), Flat(Goal(phase)), duration);
}

void QuadrupedRecovery::Step(const QuadrupedReading& reading, double dt, PerLeg* q, PerLeg* dq) {
  left_ -= dt;
  move_.Advance(dt);
  if (left_ <= 0 && phase_ != Phase::kOver) {
    if (phase_ != Phase::kFold) {
      Enter(Phase::kFold, reading);
    } else if (reading.up.z() > kUpright) {
      phase_ = Phase::kOver;
    } else {
      right_down_ = reading.up.y() > 0;
      Enter(reading.up.z() < kOnBack ? Phase::kFromBack : Phase::kFromSide, reading);
    }
  }
  for (std::size_t i = 0; i < 12; ++i) {
    (*q)[i / 3][static_cast<Eigen::Index>(i % 3)] = move_.q(i);
    (*dq)[i / 3][static_cast<Eigen::Index>(i % 3)] = move_.dq(i);
  }
}

}  // namespace understudy
