// Estimates the attitude of an inertial unit from its own rates and accelerations.
#pragma once

#include <Eigen/Geometry>

namespace understudy::sensors {

// A complementary filter on rotations, after R. Mahony, T. Hamel and J.-M. Pflimlin, "Nonlinear
// complementary filters on the special orthogonal group", IEEE Transactions on Automatic Control
// 53(5), 2008, the passive form: it integrates the gyroscope, turns towards the vertical that the
// accelerometer shows, and learns the gyroscope's bias from how far it has to. Nothing shows it the
// heading, which therefore drifts with the bias about the vertical; an acceleration that lasts
// tilts it. Which filter the robots have is not published: that it is this one is *assumed*.
class AttitudeFilter {
 public:
  // `gain` [1/s] and `trim` [1/s²] weigh the accelerometer in the attitude and in the bias; `dt`
  // [s] is the time between steps, above 0.
  AttitudeFilter(double gain, double trim, double dt) : gain_(gain), trim_(trim), dt_(dt) {}

  // Goes on with these in place of the constructor's.
  void SetGains(double gain, double trim) {
    gain_ = gain;
    trim_ = trim;
  }

  // Begins anew at rest, with the heading of `R_WI` and the tilt that the specific force f_WI_I
  // [m/s²] shows, and no bias.
  void Restart(const Eigen::Quaterniond& R_WI, const Eigen::Vector3d& f_WI_I);
  // Takes the rate [rad/s] over the last dt and the specific force at its end.
  void Step(const Eigen::Vector3d& w_WI_I, const Eigen::Vector3d& f_WI_I);

  const Eigen::Quaterniond& R_WI() const { return R_WI_; }

 private:
  double gain_, trim_, dt_;
  Eigen::Quaterniond R_WI_{1, 0, 0, 0};
  Eigen::Vector3d correction_{0, 0, 0};  // rad/s, minus the bias it has learnt
};

}  // namespace understudy::sensors
