// What a humanoid's own controller works out about its body from joint angles and its inertial
// unit.
#pragma once

#include <span>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// The underside of a foot: a rectangle.
struct Sole {
  double half_length = 0;            // m, forwards
  double half_width = 0;             // m
  Eigen::Vector3d p_OS{0, 0, 0};     // m, its centre, from O, world axes
  Eigen::Vector3d forward{1, 0, 0};  // where the toes point, world axes, length 1
  Eigen::Vector3d up{0, 0, 1};       // away from the ground, likewise
};

// Kinematics and gravity of a robot on its feet. Knows nothing of where the robot is: O, from which
// places are told, is the middle between the centres of the soles, and "at rest" is what the soles
// are. Axes are the world's. Works on an mjData of its own; the simulated world is neither read nor
// changed. Allocates in the constructor only.
class BodyModel {
 public:
  // `model`, as LoadWorldModel makes it with the same spec, must outlive the body model. Soles are
  // flat in the pose whose joint angles are all 0: true of every humanoid whose description is
  // here. Throws ModelError when the spec has no feet or one has no geoms in the model.
  BodyModel(const mjModel& model, const robot::RobotSpec& spec);

  // Angles [rad] and rates [rad/s] in motor order and LowState's unit, all of one instant.
  // Everything below is of that instant; before the first call, of joint angles 0 and upright.
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

  // Whether the motor is between base and sole.
  bool IsOfLeg(std::size_t motor) const { return joints_[motor].foot >= 0; }
  // kg that the motor carries when the base is held: what hangs from its joint.
  double CarriedMass(std::size_t motor) const;

  // What the motor feels when its joint is accelerated in the pose of angles 0 and nothing is
  // touched, kg·m²: 1 / (M⁻¹)ii. Computed once.
  double FeltInertia(std::size_t motor) const { return joints_[motor].felt_inertia; }

  // The nearest angle [rad] to `q` that the joint can reach.
  double WithinRange(std::size_t motor, double q) const;

  // Torque [N·m] with which the motor holds what hangs from its joint when the base is held.
  double GravityTorque(std::size_t motor) const;

  // Adds to `tau`, in motor order, the joint torques [N·m] with which the leg presses so that the
  // ground answers with `force` [N] at the sole's centre and `moment` [N·m] about it: -Jᵀ w.
  void AddGroundReaction(std::size_t foot, const Eigen::Vector3d& force,
                         const Eigen::Vector3d& moment, std::span<double> tau) const;

 private:
  struct Joint {
    int id = 0;
    int q_address = 0;
    int body = 0;
    int foot = -1;           // whose leg it is of
    bool turns_imu = false;  // is between base and inertial unit
    double felt_inertia = 0;
    Eigen::Vector3d axis{0, 0, 0}, anchor{0, 0, 0};  // in base axes, from the base
  };
  struct Foot {
    int body = 0;
    Eigen::Vector3d centre{0, 0, 0};                // of the sole, in the body's frame
    Eigen::Vector3d forward{1, 0, 0}, up{0, 0, 1};  // likewise
    Eigen::Vector3d p_BS{0, 0, 0};
  };

  void ReadPlaces();
  void FindSole(const robot::RobotSpec& spec, std::size_t foot);
  void FindInertia();
  bool IsBelow(int body, int ancestor) const;

  const mjModel& model_;
  mjcf::DataHandle data_;
  int base_body_ = 0;
  int imu_site_ = 0;
  double mass_ = 0;
  double gravity_ = 0;
  std::vector<Joint> joints_;  // motor order
  std::vector<Foot> feet_;
  std::vector<Sole> soles_;
  std::vector<double> carried_mass_;          // by body, of it and all below
  std::vector<Eigen::Vector3d> carried_com_;  // likewise, from the base, base axes
  Eigen::Matrix3d R_WB_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d w_WB_W_{0, 0, 0};
  Eigen::Vector3d p_OC_{0, 0, 0}, v_OC_{0, 0, 0}, p_OB_{0, 0, 0}, v_OB_{0, 0, 0};
};

}  // namespace understudy::motion
