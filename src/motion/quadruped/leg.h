// The kinematics of a leg of three hinges, in closed form.
#pragma once

#include <Eigen/Core>

#include "motion/quadruped/figures.h"

namespace understudy::motion {

// Where the links of a leg are at some angles: the origins of hip, thigh, calf and foot [m] and the
// rotations of the first three, all in the base's frame.
struct LegPlaces {
  Eigen::Matrix3d R_hip, R_thigh, R_calf;
  Eigen::Vector3d hip, thigh, calf, foot;
};

// How a point of the calf, and the foot's centre, moves per angle: m/rad, a column per joint.
Eigen::Matrix3d CalfJacobian(const LegPlaces& places, const Eigen::Vector3d& point);
Eigen::Matrix3d FootJacobian(const LegPlaces& places);

// Angles are hip, thigh, calf [rad]; points are in the base's frame [m]. The foot is the centre of
// its ball or tyre.
class QuadrupedLeg {
 public:
  explicit QuadrupedLeg(const LegFigures& figures);

  // What the functions below take, so that a controller works it out once a step.
  LegPlaces Place(const Eigen::Vector3d& q) const;

  // The sum of mass times place of its links, kg·m.
  Eigen::Vector3d MassMoment(const LegPlaces& places) const;

  // Inertia of joints, links and motors while the base stands still, kg·m².
  Eigen::Matrix3d MassMatrix(const LegPlaces& places) const;

  // What its links add to the base's inertia about the point p [m], kg·m².
  Eigen::Matrix3d InertiaAbout(const LegPlaces& places, const Eigen::Vector3d& p) const;

  // Torques [N·m] that joints turning with dq [rad/s] lose by friction.
  Eigen::Vector3d FrictionTorque(const Eigen::Vector3d& dq) const;

  // Torques [N·m] that hold the leg's own links where gravity pulls along -`up` with `gravity`
  // m/s².
  Eigen::Vector3d HoldingTorque(const LegPlaces& places, const Eigen::Vector3d& up,
                                double gravity) const;

  // The way [m] from the foot's centre to where it touches ground that lies across `up`, a unit
  // vector: straight down from a ball, to the edge that it leans on from a tyre.
  Eigen::Vector3d Sole(const LegPlaces& places, const Eigen::Vector3d& up) const;

  // The angles, within their ranges and with the knee bent backwards, that bring the foot to or,
  // where it cannot get there, near `foot`.
  Eigen::Vector3d Angles(const Eigen::Vector3d& foot) const;

  // Returns whether they bring it there.
  bool Reach(const Eigen::Vector3d& foot, Eigen::Vector3d* q) const;

  double mass() const;
  // m from the thigh's axis to the foot of a straight leg.
  double length() const { return thigh_length_ + calf_length_; }
  const LegFigures& figures() const { return figures_; }

 private:
  LegFigures figures_;
  double side_;  // m, how far the foot is beside the hip's axis
  // Length and angle at zero of thigh and calf in the plane of the leg.
  double thigh_length_, thigh_angle_, calf_length_, calf_angle_;
};

}  // namespace understudy::motion
