// A smooth way from one set of joint angles to another.
#pragma once

#include <span>
#include <vector>

namespace understudy::motion {

// How far a smooth move has come at the fraction `s` of its time: 0 up to s = 0, 1 from s = 1, with
// no rate and no acceleration at both ends (10 s³ - 15 s⁴ + 6 s⁵).
double SmoothStep(double s);
double SmoothStepRate(double s);  // its derivative

// All joints leave and arrive together. Allocates in the constructor only.
class JointMove {
 public:
  explicit JointMove(std::size_t joints) : from_(joints), to_(joints) {}

  // From `from` [rad] to `to` [rad], both of the constructor's size, in `duration` s; 0 is at once.
  void Begin(std::span<const double> from, std::span<const double> to, double duration);

  // Goes on by dt [s]. Before the first Begin all angles are 0 and the move is over.
  void Advance(double dt) { elapsed_ += dt; }

  double q(std::size_t joint) const;   // rad
  double dq(std::size_t joint) const;  // rad/s
  bool over() const { return elapsed_ >= duration_; }

 private:
  std::vector<double> from_, to_;
  double duration_ = 0;
  double elapsed_ = 0;
};

}  // namespace understudy::motion
