// Computes the state of a humanoid's body from joint angles and IMU, for its controller.
#pragma once

#include <span>
#include <string>
#include <vector>

#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// The underside of a foot: a rectangle.
struct Sole {
  double half_length = 0;            // m, forwards
  double half_width = 0;             // m
  Eigen::Vector3d p_OS{0, 0, 0};     // m, its centre, from O, world axes
  Eigen::Vector3d forward{1, 0, 0};  // direction of the toes, world axes, unit length
  Eigen::Vector3d up{0, 0, 1};       // away from the ground, likewise
};

// Kinematics and gravity of a robot on its feet. Positions count from O, the middle between the
// centres of the soles, which are taken to be at rest; axes are the world's. It uses its own mjData
// and neither reads nor changes the simulated world. Allocates only in the constructor.
class BodyModel {
 public:
  // `model` is that of LoadWorldModel with the same spec and must outlive the body model. Soles
  // must be flat at joint angles 0, as for all humanoids here. Throws ModelError if the spec has no
  // feet or the model no geoms for one (physics::FootGeoms).
  BodyModel(const mjModel& model, const robot::RobotSpec& spec);

  // Takes angles [rad] and rates [rad/s] in motor order and LowState's IMU, all of one instant. The
  // functions below refer to that instant; before the first call, to joint angles 0 and an upright
  // base.
  void Update(std::span<const double> q, std::span<const double> dq, const robot::ImuReading& imu);

  double motor_period() const;                                    // s, of the motor law
  double mass() const { return mass_; }                           // kg
  double gravity() const { return gravity_; }                     // m/s²
  const Eigen::Vector3d& com() const { return p_OC_; }            // m, from O
  const Eigen::Vector3d& com_velocity() const { return v_OC_; }   // m/s, against the soles
  const Eigen::Vector3d& base() const { return p_OB_; }           // m, base body's origin, from O
  const Eigen::Vector3d& base_velocity() const { return v_OB_; }  // m/s, against the soles
  const Eigen::Matrix3d& attitude() const { return R_WB_; }       // of the base body
  const Eigen::Vector3d& base_rate() const { return w_WB_W_; }    // rad/s
  std::span<const Sole> soles() const { return soles_; }          // in RobotSpec::feet order

  // The body that a sole is part of, and the sole in its frame.
  struct Foot {
    int body = 0;
    Eigen::Vector3d centre{0, 0, 0};                // m
    Eigen::Vector3d forward{1, 0, 0}, up{0, 0, 1};  // of length 1
    Eigen::Vector3d p_BS{0, 0, 0};                  // m, its centre, base axes
  };
  std::span<const Foot> feet() const { return feet_; }  // in RobotSpec::feet order

  // Returns whether the motor is between base and sole.
  bool IsOfLeg(std::size_t motor) const { return joints_[motor].foot >= 0; }
  // Returns the mass [kg] that hangs from the motor's joint when the base is held.
  double CarriedMass(std::size_t motor) const;

  // Returns the effective inertia [kg·m²] at the joint at angles 0 without contacts: 1 / (M⁻¹)ii.
  // Computed once.
  double FeltInertia(std::size_t motor) const { return joints_[motor].felt_inertia; }

  // Returns `q` [rad] clamped to the joint's range.
  double WithinRange(std::size_t motor, double q) const;

  // Returns the torque [N·m] that holds the mass below the joint when the base is held.
  double GravityTorque(std::size_t motor) const;

  // Adds to `tau`, in motor order, the joint torques [N·m] for which the ground reacts with `force`
  // [N] at the sole's centre and `moment` [N·m] about it: -Jᵀ w.
  void AddGroundReaction(std::size_t foot, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& moment, std::span<double> tau) const;

 private:
  struct Joint {
    int id = 0;
    int q_address = 0;
    int body = 0;
    int foot = -1;           // index of its leg's foot
    bool turns_imu = false;  // is between base and IMU
    double felt_inertia = 0;
    Eigen::Vector3d axis{0, 0, 0}, anchor{0, 0, 0};  // in base axes, from the base
  };
  void ReadPlaces();
  void FindSole(std::span<const int> geoms, const std::string& name, std::size_t foot);
  void FindInertia();
  bool IsBelow(int body, int ancestor) const;

  const mjModel& model_;
  mjModel bones_;  // a view of it without geoms, which kinematics need not place
  mjcf::DataHandle data_;
  int base_body_ = 0;
  int imu_site_ = 0;
  double mass_ = 0;
  double gravity_ = 0;
  std::vector<Joint> joints_;  // motor order
  std::vector<Foot> feet_;
  std::vector<Sole> soles_;
  std::vector<double> carried_mass_;          // kg, by body, including all below
  std::vector<Eigen::Vector3d> carried_com_;  // likewise, from the base, base axes
  Eigen::Matrix3d R_WB_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d w_WB_W_{0, 0, 0};
  Eigen::Vector3d p_OC_{0, 0, 0}, v_OC_{0, 0, 0}, p_OB_{0, 0, 0}, v_OB_{0, 0, 0};
};

}  // namespace understudy::motion
