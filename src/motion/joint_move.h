// A smooth motion from one set of joint angles to another.
#pragma once

#include <span>
#include <vector>

namespace understudy::motion {

// The position of a smooth motion from 0 to 1 at the fraction `s` of its time, with zero rate and
// acceleration at both ends: 10 s³ - 15 s⁴ + 6 s⁵, constant outside 0..1.
double SmoothStep(double s);
double SmoothStepRate(double s);  // the derivative

// All joints start and end together. Allocates only in the constructor.
class JointMove {
 public:
  explicit JointMove(std::size_t joints) : from_(joints), to_(joints) {}

  // Starts a move from `from` to `to` [rad], both of the constructor's size, in `duration` [s], 0
  // for an immediate one.
  void Begin(std::span<const double> from, std::span<const double> to, double duration);

  // Advances by dt [s]. Before the first Begin all angles are 0 and the move is over.
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
