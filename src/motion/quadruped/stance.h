// Standing on feet that stay where they are, while the body moves over them.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/quadruped/behaviour.h"

namespace understudy::motion {

// How a body is held over its footprints. Frame F: under the middle of the footprints, at the mean
// height of the ground there, x the way they point, z up.
struct StancePose {
  Eigen::Vector3d place{0, 0, 0};  // m: x and y of the centre of mass, z of the base
  Eigen::Vector3d rpy{0, 0, 0};    // rad, of the base: R = Rz Ry Rx
  Eigen::Vector3d paw{0, 0, 0};    // m, how far the front right foot is off its footprint
  double paw_load = 1;             // 1 it carries its part, 0 nothing
};

// Leads the body from pose to pose. Height and orientation come from the joint angles and the
// inertial unit and are corrected until they fit, on any ground. Allocates nothing.
class Stance final : public Behaviour {
 public:
  // `body` must outlive it.
  explicit Stance(const QuadrupedBody& body) : body_(body) {}

  // The feet stand where they are from now on; the pose is the present one.
  void Begin(const QuadrupedReading& reading);

  // The pose nearest to `wanted` that the legs can hold with trunk and knees clear of the ground:
  // the body is lowered or raised first, and tilted less where that is not enough.
  StancePose Feasible(const StancePose& wanted) const;

  // Leads there smoothly in `duration` s, from where the body is being held.
  void MoveTo(const StancePose& pose, double duration);

  // Leads there as fast as a body of its kind turns, wherever it is on its way to: for targets that
  // change often. A move that is not over goes there first.
  void Follow(const StancePose& pose);

  // Points of the feet in the base when the body is held so, m.
  PerLeg FeetInBase(const StancePose& pose) const { return FeetInBase(pose, com_); }

  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;

  // The last MoveTo has got there.
  bool over() const override { return elapsed_ >= duration_; }
  // Where the body is, as of the last Begin or Step. `place` is that of the base, not of the mass.
  const StancePose& measured() const { return measured_; }
  // How it is being held.
  const StancePose& held() const { return held_; }
  // rad/s, how fast roll, pitch and yaw of that change while it follows.
  const Eigen::Vector3d& held_rate() const { return v_rpy_; }

 private:
  void Measure(const QuadrupedReading& reading, double paw_load);
  void Lead(double dt);
  PerLeg FeetInBase(const StancePose& pose, const Eigen::Vector3d& com) const;
  bool CanHold(const StancePose& pose) const;

  const QuadrupedBody& body_;
  PerLeg footprints_;  // centres of the feet in F, m
  StancePose measured_;
  Eigen::Matrix3d R_FB_ = Eigen::Matrix3d::Identity();
  StancePose from_, to_, held_;
  Eigen::Vector3d v_place_{0, 0, 0}, v_rpy_{0, 0, 0};  // rates of `held_` while following
  double duration_ = 0, elapsed_ = 0;
  Eigen::Vector3d com_at_begin_{0, 0, 0};   // in the base, m: what is feasible is judged with
  Eigen::Vector3d com_{0, 0, 0};            // in the base, m
  double trim_height_ = 0;                  // m, what corrects the height
  Eigen::Vector3d trim_rotation_{0, 0, 0};  // rad, what corrects the orientation, about F's axes
  PerLeg last_q_;
  bool fresh_ = true;
};

}  // namespace understudy::motion
