// Kinematics and dynamics of a whole humanoid from joint angles and IMU, for its walk.
#pragma once

#include <array>
#include <span>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <mujoco/mujoco.h>

#include "mjcf/mujoco_handles.h"
#include "motion/humanoid/body_model.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::motion {

// All positions count from the base's origin, all velocities are against it, in world axes: where
// the base is and how fast it goes is what WalkEstimator computes. Rates and accelerations of the
// model have MuJoCo's order; the base has six of them, of which three turn it in its own axes.
// Allocates only in the constructor.
class WalkBody {
 public:
  using Jacobian = Eigen::Matrix<double, 6, Eigen::Dynamic, Eigen::RowMajor>;
  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

  struct Foot {
    double side = 1;               // 1 left, -1 right
    std::vector<int> motors;       // of the leg, from the base to the foot
    int knee = -1;                 // the motor of the knee
    int hip_pitch = -1;            // the motor of the hip that pitches
    int hip_roll = -1;             // the motor of the hip that rolls
    double bend = 1;               // sign of a bent knee's angle
    Eigen::Vector3d p{0, 0, 0};    // m, the sole's centre
    Eigen::Matrix3d R;             // of the sole's axes toes, left, up
    Jacobian J;                    // its velocity and rate by the rates of the model
    Eigen::Vector3d v{0, 0, 0};    // m/s
    Eigen::Vector3d w{0, 0, 0};    // rad/s
    Eigen::Vector3d a0{0, 0, 0};   // m/s², its acceleration while no rate changes
    Eigen::Vector3d dw0{0, 0, 0};  // rad/s², the same

    double yaw() const { return std::atan2(R(1, 0), R(0, 0)); }  // rad
  };

  // `model` and `spec` are as for BodyModel, which `soles` is; the former must outlive it.
  WalkBody(const mjModel& model, const robot::RobotSpec& spec, const BodyModel& soles);

  // Whether its base is free and its legs have five or six joints and a knee each.
  bool can_walk() const { return can_walk_; }
  // Whether no joint holds the soles' roll.
  bool rolls() const { return feet_[0].motors.size() == 5; }

  // Takes angles [rad] and rates [rad/s] in motor order and LowState's IMU, all of one instant.
  void Update(std::span<const double> q, std::span<const double> dq, const robot::ImuReading& imu);

  double mass() const { return mass_; }        // kg
  double gravity() const { return gravity_; }  // m/s²
  int base_dof() const { return base_dof_; }   // the first of six
  std::size_t motors() const { return dofs_.size(); }
  int dof(std::size_t motor) const { return dofs_[motor]; }
  double limit(std::size_t motor) const { return limits_[motor]; }       // N·m
  const std::array<Foot, 2>& feet() const { return feet_; }              // RobotSpec::feet order
  const Matrix& M() const { return M_; }                                 // inertia
  const Eigen::VectorXd& bias() const { return bias_; }                  // gravity, Coriolis
  const Eigen::Matrix3d& R_WB() const { return R_WB_; }                  // of the base
  const Eigen::Vector3d& w_WB_W() const { return w_WB_W_; }              // rad/s
  const Eigen::Vector3d& com() const { return com_; }                    // m
  const Eigen::Vector3d& com_velocity() const { return com_velocity_; }  // m/s
  const Eigen::Vector3d& momentum() const { return momentum_; }          // N·m·s, about the base
  const Eigen::Vector3d& imu_velocity() const { return imu_velocity_; }  // m/s, of the IMU

  // Returns the torque [N·m] that the joint's friction takes at that rate [rad/s].
  double Friction(std::size_t motor, double dq) const;

 private:
  struct Link {  // of the chain from the base to the IMU
    Eigen::Quaterniond turn;
    int motor = -1;
    Eigen::Vector3d axis{0, 0, 0};
  };
  struct SoleFrame {
    int body = 0;
    Eigen::Vector3d centre{0, 0, 0};
    Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  // of the sole in the body
  };

  void FindLegs(const robot::RobotSpec& spec);
  void FindImu(const robot::RobotSpec& spec);
  void PlaceBase(std::span<const double> dq, const robot::ImuReading& imu);
  void ReadFeet();

  mjModel bones_;  // a view of the model without geoms, which kinematics need not place
  mjcf::DataHandle data_;
  double mass_ = 0, gravity_ = 0;
  int base_body_ = 0, base_dof_ = 0, base_q_ = 0, imu_site_ = 0;
  bool can_walk_ = false;
  std::vector<int> joints_, dofs_, q_addresses_;  // motor order
  std::vector<double> limits_;                    // N·m, motor order
  std::vector<Link> chain_;
  Eigen::Quaterniond R_LI_{1, 0, 0, 0};  // of the IMU in the last link
  std::array<SoleFrame, 2> soles_;
  std::array<Foot, 2> feet_;
  Matrix M_;
  Eigen::VectorXd bias_;
  Jacobian imu_J_;
  Eigen::Matrix3d R_WB_ = Eigen::Matrix3d::Identity();
  Eigen::Vector3d w_WB_W_{0, 0, 0};
  Eigen::Vector3d com_{0, 0, 0}, com_velocity_{0, 0, 0}, momentum_{0, 0, 0}, imu_velocity_{0, 0, 0};
};

}  // namespace understudy::motion
