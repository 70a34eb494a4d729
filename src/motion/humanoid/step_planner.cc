#include "motion/humanoid/step_planner.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace understudy::motion {
namespace {

// All assumed, tried on every robot here with pushes, sensor noise and delay.
constexpr double kPressureGain = 2;  // how far the pressure runs ahead of the capture point's error
constexpr double kLengthShare = 0.8;  // of a sole's half length, that it may press on
constexpr double kWidthShare = 0.6;   // of its half width
constexpr double kLongStep = 0.5;     // m ahead or back, from which a step is made sooner
constexpr double kMostStep = 0.6;     // m, ahead and back
constexpr double kWider = 0.2;        // m more than width, from which a step is made sooner
constexpr double kFirstWider = 0.06;  // m more than width, of a first step
constexpr double kWidest = 0.33;      // m more than width, of a step
constexpr double kClearance = 0.01;   // m more than least_width
constexpr double kLeastTime = 0.3;    // s, of a step
constexpr double kLeastLeft = 0.08;   // s, after a change of its time
constexpr double kFrozen = 0.05;      // s, at its end in which the time is kept
constexpr double kTimeGrid = 0.01;    // s

}  // namespace

Eigen::Vector2d StepPlanner::Orbit(double side, const Eigen::Vector3d& velocity) const {
  const StepFigures& f = figures_;
  const double growth = std::exp(f.rate * f.time);
  const double width =
      std::max(f.width, f.least_width + std::abs(velocity.y()) * f.time + kClearance);
  return velocity.head<2>() * f.time / (growth - 1) -
         Eigen::Vector2d(0, side * width / (growth + 1));
}

Eigen::Vector2d StepPlanner::Landing(double remaining, double side, const Eigen::Vector2d& capture,
                                     const Eigen::Vector2d& pressure,
                                     const Eigen::Vector3d& velocity) const {
  return pressure + (capture - pressure) * std::exp(figures_.rate * remaining) -
         Eigen::Rotation2Dd(velocity.z() * remaining) * Orbit(-side, velocity);
}

bool StepPlanner::FitsAside(double side, double capture) const {
  const StepFigures& f = figures_;
  const double edge = kWidthShare * f.half_width;
  const double pressure = std::clamp(kPressureGain * capture, -edge, edge);
  const double landing =
      Landing(f.time - kSharedTime / 2, side, {0, capture}, {0, pressure / 2}, {0, 0, 0}).y();
  return -side * landing < f.width + kFirstWider;
}

StepPlan StepPlanner::Step(double elapsed, double side, const Eigen::Vector2d& capture,
                           const Eigen::Vector3d& velocity, double foot_yaw) {
  const StepFigures& f = figures_;
  StepPlan plan;
  const Eigen::Vector2d on_orbit =
      Orbit(side, velocity) * std::exp(f.rate * std::max(0.0, elapsed - kSharedTime / 2));
  const Eigen::Rotation2Dd foot(foot_yaw);
  const Eigen::Vector2d most(kLengthShare * f.half_length, kWidthShare * f.half_width);
  const Eigen::Vector2d wanted = foot.inverse() * (kPressureGain * (capture - on_orbit));
  plan.pressure = foot * Eigen::Vector2d(wanted.cwiseMin(most).cwiseMax(-most));

  // The pressure is expected to stay half as far out.
  const auto landing = [&](double time) {
    const double remaining = std::max(0.0, time + kSharedTime / 2 - elapsed);
    return Landing(remaining, side, capture, plan.pressure / 2, velocity);
  };
  const auto fits = [&](const Eigen::Vector2d& p) {
    const double aside = -side * p.y();
    return std::abs(p.x()) < kLongStep && aside > f.least_width + kClearance &&
           aside < f.width + kWider;
  };
  if (elapsed > kSharedTime && elapsed <= time_ - kFrozen) {
    const double least = std::min(time_, std::max(kLeastTime, elapsed + kLeastLeft));
    double time = f.time;
    while (time - kTimeGrid >= least && !fits(landing(time))) time -= kTimeGrid;
    time_ = time;
  }
  plan.time = time_;
  plan.landing = landing(time_);
  plan.landing.x() = std::clamp(plan.landing.x(), -kMostStep, kMostStep);
  plan.landing.y() = -side * std::clamp(-side * plan.landing.y(), f.least_width, f.width + kWidest);
  plan.turn = velocity.z() * (std::max(0.0, time_ + kSharedTime / 2 - elapsed) + f.time / 2);
  return plan;
}

}  // namespace understudy::motion
