// Estimates how a quadruped's base moves.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/quadruped/body.h"

namespace understudy::motion {

// Estimates velocity and height of the base from the inertial unit, joint angles and rates and foot
// forces: a linear Kalman filter that integrates the specific force and is corrected by the legs,
// whose feet stand still or roll where they carry load. It takes the unit's attitude for exact.
//
// The state is the velocity v of the inertial unit and the way d to each foot from there, in the
// world's axes. Noise is the same along every axis, so one covariance of 5 x 5 serves all three:
//
//   v' = R f + g     d' = u - v     d = R (foot - unit)     v = u - R (w x (foot - unit) + J dq)
//
// u is the velocity of the centre of a foot or wheel that rolls on level ground, over its sole. A
// robot that lies on its body has no foot that carries its load: once it turns slowly and feels its
// weight alone for a while, its velocity is taken for 0.
// Form and order of the noise: Bloesch et al., State Estimation for Legged Robots, Robotics:
// Science and Systems 2012, and PositionVelocityEstimator.cpp of Cheetah-Software
// (docs/dev/sources.md#algorithms-and-training-environments); ways to the feet in place of places
// in the world leave nothing that cannot be observed, and no ground has to be flat. Allocates
// nothing.
class QuadrupedEstimator {
 public:
  // `body` must outlive it.
  explicit QuadrupedEstimator(const QuadrupedBody& body) : body_(body) {}

  // At rest, with the ground under all four feet. Before the first Begin: all is 0.
  void Begin(const QuadrupedReading& reading);

  // One step of dt [s], at whose end `reading` was taken. `stands` from 0 to 1 says how far a foot
  // may be believed to stand: 0 while a gait swings it. `may_rest` says that the legs do not carry
  // the robot, which may lie still.
  void Step(const QuadrupedReading& reading, double dt,
            const std::array<double, 4>& stands = {1, 1, 1, 1}, bool may_rest = false);

  // m/s, of the base's origin. While no foot carries load it comes from the inertial unit alone and
  // fades within seconds, or at once if the robot rests.
  const Eigen::Vector3d& v_WB_W() const { return v_WB_W_; }

  // m, of the base's origin from where it was at Begin, in the world's axes: drifts with every step
  // a foot takes.
  const Eigen::Vector3d& p_WB() const { return p_WB_; }

  // m, of the base's origin over the mean of the ground under the feet that carry load; while none
  // does, over where they last were.
  double height() const { return height_; }

 private:
  using Vector5 = Eigen::Matrix<double, 5, 1>;

  void Predict(const QuadrupedReading& reading, double dt);
  // Whether the inertial unit has been at rest for a while.
  bool Rests(const QuadrupedReading& reading, double dt);
  // Row `i` of the state has been measured [m or m/s] with that variance.
  void Correct(Eigen::Index i, const Eigen::RowVector3d& measured, double variance);
  void Tell(const QuadrupedReading& reading, double dt);

  const QuadrupedBody& body_;
  Eigen::Matrix<double, 5, 3> x_ = Eigen::Matrix<double, 5, 3>::Zero();  // v, then d by leg
  Eigen::Matrix<double, 5, 5> P_ = Eigen::Matrix<double, 5, 5>::Zero();
  std::array<double, 4> trust_{};  // that a foot stands, 0 to 1
  PerLeg u_;                       // m/s
  Eigen::Vector3d turn_{0, 0, 0};  // rad/s, m/s²: angular velocity and specific force in the base,
  Eigen::Vector3d force_{0, 0, 0};  // low-passed
  double rested_ = 0;               // s
  Eigen::Vector3d v_WB_W_{0, 0, 0};
  Eigen::Vector3d p_WB_{0, 0, 0};
  double height_ = 0;
};

}  // namespace understudy::motion
