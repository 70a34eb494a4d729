// Walking: diagonal pairs of feet step in turn.
#pragma once

#include <array>

#include <Eigen/Core>

#include "motion/quadruped/behaviour.h"
#include "motion/quadruped/estimator.h"
#include "motion/quadruped/gait_clock.h"
#include "motion/quadruped/ground_plane.h"
#include "motion/quadruped/velocity_wish.h"
#include "robot/motion_spec.h"

namespace understudy::motion {

// A trot on sensed values. Feet that stand push the body along its way: a law of its accelerations,
// shared among them by ShareForces. Feet that swing go where the next stance needs them: under the
// hips, and beyond by half of what a stance covers and by what brings the falling pendulum to rest
// (capture point). Frame T is the base's without roll and pitch; W is the estimator's. Allocates
// nothing.
class Trot final : public Behaviour {
 public:
  // All must outlive it.
  Trot(const QuadrupedBody& body, const QuadrupedEstimator& estimator,
       const robot::QuadrupedMotionSpec& spec);

  // From standing on four feet; `rest` are points of the base [m] under which feet stand at rest.
  void Begin(const QuadrupedReading& sensed, const PerLeg& rest);
  // From a body that topples while its feet roll with that velocity [m/s, frame T]: steps at once,
  // first with the pair of feet that holds the falling body less.
  void BeginToppling(const QuadrupedReading& sensed, const PerLeg& rest,
                     const Eigen::Vector3d& rolling);

  // Forward, left m/s, turn rad/s, until another is asked for.
  void Ask(const Eigen::Vector3d& velocity) { wish_.Ask(velocity); }
  // What it would take of that.
  Eigen::Vector3d Taken(const Eigen::Vector3d& velocity) const { return wish_.Taken(velocity); }
  // How the body is carried: height of the base over the ground [m], roll and pitch [rad].
  void Carry(double height, const Eigen::Vector3d& rpy);
  // Whether it is to come to rest soon, to go on on wheels.
  void Hurry(bool on) {
    hurries_ = on;
    wish_.Hurry(on);
  }
  // Whether it steps on the spot where it would stand.
  void KeepStepping(bool on) { keeps_stepping_ = on; }

  void Step(const QuadrupedReading& sensed, double dt, LegCommand* legs) override;

  // Nothing is asked for, and it stands on four feet.
  bool over() const override { return clock_.halted(); }

  // How far each foot may be believed to stand, 0 to 1, for the estimator.
  std::array<double, 4> stands() const;

 private:
  struct Foot {
    bool swings = false;            // as of the last step
    bool felt = true;               // has felt the ground since it last swung
    Eigen::Vector3d from{0, 0, 0};  // of its swing, W
    Eigen::Vector3d on{0, 0, 0};    // where it stands or last stood, W
  };

  void Begin(const QuadrupedReading& sensed, const PerLeg& rest, const Eigen::Vector3d& rolling,
             double wait, double phase);
  void See(const QuadrupedReading& sensed);
  void Plan(double dt);
  void Watch(const QuadrupedReading& sensed);
  void Push(const QuadrupedReading& sensed, LegCommand* legs);
  Eigen::Vector3d Acceleration() const;                            // of the centre of mass, T
  Eigen::Vector3d TurnRate(const QuadrupedReading& sensed) const;  // rad/s², of the base, T
  double Load(std::size_t leg) const;  // 0 to 1, how much of its most a foot may carry now
  Eigen::Vector3d Foothold(std::size_t leg) const;
  void Swing(const QuadrupedReading& sensed, std::size_t leg, LegCommand* legs) const;
  GaitTiming WantedGait() const;

  const QuadrupedBody& body_;
  const QuadrupedEstimator& estimator_;
  const robot::QuadrupedMotionSpec& spec_;
  double omega_;  // rad/s, of the pendulum that the standing robot is
  VelocityWish wish_;
  GaitClock clock_;
  GroundPlane ground_;
  std::array<Foot, 4> feet_;
  PerLeg rest_;    // feet at rest about the centre of mass, T, m
  PerLeg forces_;  // N, of the last step, T
  Eigen::Matrix3d R_WT_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d com_{0, 0, 0}, v_com_{0, 0, 0};  // W: m, m/s
  double turns_ = 0;                               // rad/s, about the vertical
  Eigen::Vector3d ahead_{0, 0, 0};  // m, W, level: how far the wanted way is ahead of the body
  double yaw_ahead_ = 0;            // rad, of the wanted heading
  double height_ = 0;               // m, that is wanted now
  double wanted_height_ = 0;        // m, and in the end
  Eigen::Vector3d wanted_rpy_{0, 0, 0};
  double idle_ = 0;      // s without a wish
  bool begins_ = false;  // no foot has lifted yet
  bool keeps_stepping_ = false;
  bool hurries_ = false;
};

}  // namespace understudy::motion
