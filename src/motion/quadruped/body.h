// A quadruped as its controller sees it: what its sensors say in the terms of legs, and what its
// legs must do to carry it.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "authority/motion.h"
#include "motion/quadruped/figures.h"
#include "motion/quadruped/leg.h"

namespace understudy::motion {

// A vector per leg, FR FL RR RL: joint angles, rates or torques as hip, thigh, calf, or a point of
// each foot.
using PerLeg = std::array<Eigen::Vector3d, 4>;

// One instant of the sensors. T is the base's frame without its roll and pitch: z up.
struct QuadrupedReading {
  PerLeg q, dq;  // rad, rad/s
  std::array<LegPlaces, 4> places;
  PerLeg feet;           // centres of the feet in the base, m
  PerLeg feet_speed;     // of the feet's centres against the base, in it, m/s
  PerLeg soles;          // from there to where they touch level ground, in the base, m
  PerLeg turn;           // of foot or wheel against the base, in the base, rad/s
  Eigen::Vector3d com;   // of the whole robot in the base, m
  Eigen::Matrix3d R_WB;  // from the inertial unit, as all that follows
  Eigen::Matrix3d R_TB;
  Eigen::Vector3d up;                // the world's up in the base
  Eigen::Vector3d w_WB_B;            // rad/s
  Eigen::Vector3d f_WI_B;            // specific force at the unit, m/s²
  std::array<double, 4> foot_force;  // N
};

class QuadrupedBody {
 public:
  explicit QuadrupedBody(const QuadrupedFigures& figures);

  // `input` has at least twelve motors and four feet.
  QuadrupedReading Read(const authority::MotionInput& input) const;

  // Joint angles that bring every foot to or near its point in the base [m].
  PerLeg Angles(const PerLeg& feet) const;

  // Returns whether they bring every one there.
  bool Reach(const PerLeg& feet, PerLeg* q) const;

  // How far the trunk reaches down from the base's origin [m], where `up` is up.
  double Depth(const Eigen::Vector3d& up) const;

  // Joint torques [N·m] that hold legs and trunk at rest against gravity when the feet carry
  // `share` of the weight, divided among them so that it does not tip and squares are least.
  // `load` from 0 to 1 says how willing each foot is; not all may be 0.
  PerLeg SupportTorque(const QuadrupedReading& reading, const std::array<double, 4>& load,
                       double share) const;

  // Of the whole robot about its centre of mass, kg·m², in the base.
  Eigen::Matrix3d Inertia(const QuadrupedReading& reading) const;

  const QuadrupedLeg& leg(std::size_t i) const { return legs_[i]; }
  // m, thigh and calf: what postures are scaled with.
  double leg_length() const { return legs_[0].length(); }
  double radius() const { return legs_[0].figures().radius; }
  double mass() const { return mass_; }                  // kg
  double gravity() const { return gravity_; }            // m/s²
  const Eigen::Vector3d& p_BI() const { return p_BI_; }  // m, the inertial unit

 private:
  std::array<double, 4> FootForces(const QuadrupedReading& reading,
                                   const std::array<double, 4>& load) const;

  std::array<QuadrupedLeg, 4> legs_;
  LinkMass trunk_;
  std::vector<TrunkShape> trunk_shapes_;
  Eigen::Quaterniond R_BI_;
  Eigen::Vector3d p_BI_;
  bool wheeled_;
  double mass_;
  double gravity_;
};

}  // namespace understudy::motion
