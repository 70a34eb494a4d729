// One robot of the simulated world: its base, joints, inertial units and feet.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "physics/inertial_unit.h"
#include "physics/touch.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::physics {

// A robot and its place in the world.
struct PlacedRobot {
  robot::RobotSpec spec;
  std::filesystem::path file{};                // its MJCF
  std::vector<std::filesystem::path> hands{};  // MJCF of its hands
  // Prefix of the robot's names in the world's model, different for each robot; "" for the only
  // robot.
  std::string prefix{};
  double x = 0, y = 0;  // m, the robot's origin in the world
  double yaw = 0;       // rad, heading of its poses
};

// Reads and drives one robot of a MujocoWorld. `q`, `dq`, base and bodies belong to the instant
// described at MujocoWorld. Allocates only in the constructor.
class RobotBody {
 public:
  // For MujocoWorld, which owns the models and `data`. `data` has the kinematics at joint angles 0.
  RobotBody(mjModel* model, mjData* data, const PlacedRobot& robot, const mjModel* nominal);

  // Puts the robot at rest at its place in that pose, with the pose's height over the ground there
  // (LiftOntoGround), and unclamps the base. A fixed base keeps the pose of its file. Other robots
  // and objects do not change. Readings are then those of the new state.
  void Reset(const robot::PoseSpec& pose);

  // Gives the joints these rates [rad/s], in motor order. Readings stay the old ones.
  void SetRates(std::span<const double> dq);

  // Sets the joint torques [N·m] in motor order, which must be finite. They act until the next call
  // or Reset.
  void Drive(std::span<const double> tau);

  // Fixes the base where it is now, as a stand does, or releases it. A fixed base is always held.
  void Clamp(bool on);
  bool clamped() const;

  // Returns position [m] and attitude (w, x, y, z) of the base in the world, and its velocity in
  // the world [m/s] and turning rate in its own axes [rad/s], of the next step; empty for a fixed
  // base.
  std::span<const double> base_position() const;
  std::span<const double> base_velocity() const;

  // How the dry friction of a joint holds.
  enum class Grip {
    kYields,  // as MuJoCo has it: it gives way slowly, by some 0.1 rad/s under a leg's weight
    kSticks,  // until more than the friction turns the joint
    kJammed,  // nothing turns the joint
  };

  // Gives the joint of a motor, by its place in motor order, `drag` [N·m] of friction more than it
  // has, and the grip of it. Both last until the next call.
  void Brake(std::size_t motor, double drag, Grip grip);

  // Returns the world's index of a body of this robot. Throws ModelError if there is none.
  int Body(const std::string& name) const;
  // The same, but returns -1 if there is none.
  int FindBody(const std::string& name) const;
  // Returns whether a body of the world is part of this robot.
  bool Has(int body) const;

  // Joint angles [rad] and rates [rad/s] in motor order.
  std::span<const double> q() const { return q_; }
  std::span<const double> dq() const { return dq_; }
  const robot::BaseReading& base() const { return base_; }
  // The acceleration of gravity [m/s²] in the world.
  Eigen::Vector3d gravity() const;
  double tilt() const;  // rad between the base's up and the world's
  const robot::ImuReading& Imu() const { return imu_.reading(); }
  // Returns default values if there is none.
  const robot::ImuReading& SecondaryImu() const { return secondary_imu_.reading(); }
  // Computes the force of the contacts on each foot [N], in spec order: the component of their
  // normal forces along FootSpec::axis, never negative.
  void FootForces(std::span<double> force) const;
  // What its hands and their pads feel: Touch::Read and Touch::Forces.
  void ReadTouch(std::span<float> cells) const { touch_.Read(*model_, *data_, cells); }
  void HandForces(std::span<double> hands) const { touch_.Forces(*model_, *data_, hands); }
  double weight() const;  // N
  // The base's up in the frame of LowState's inertial unit at joint angles 0.
  const Eigen::Vector3d& imu_up() const { return imu_up_; }
  // Returns the rotor's inertia at each joint [kg·m²] in motor order.
  std::vector<double> Armatures() const;
  // Computes the power [W] that dry friction and damping take in each joint at its rate, in motor
  // order; none in a jammed one, which does not turn.
  void FrictionPower(std::span<double> power) const;
  // Returns the ranges of the joints [rad], in motor order; infinite where there is none.
  std::vector<std::array<double, 2>> ranges() const;

  // The world's model, and the robot's description with the names in that model.
  const mjModel& model() const { return *model_; }
  // The same before chance changed it: what the robot's own controller knows of itself.
  const mjModel& nominal() const { return *nominal_; }
  const robot::RobotSpec& spec() const { return spec_; }

 private:
  friend class MujocoWorld;

  struct JointFriction {
    double torque = 0;                  // N·m
    std::array<double, 2> impedance{};  // dmin and dmax of MuJoCo's solimp
  };

  InertialUnit FindImu(const std::string& site) const;
  void ReadMotion();        // once mj_step1 has computed it
  void ReadAcceleration();  // once mj_step2 has
  void Forget();
  bool has_fixed_base() const { return clamp_ < 0; }

  mjModel* model_;
  const mjModel* nominal_;
  mjData* data_;
  std::string prefix_;
  robot::RobotSpec spec_;
  double x_, y_, yaw_;                       // m, rad
  std::vector<int> q_address_, dq_address_;  // in motor order
  std::vector<JointFriction> friction_;      // in motor order, as the model has it
  std::vector<int> foot_of_geom_;            // -1 where the geom is no foot's
  std::vector<Eigen::Vector3d> foot_axis_;
  Touch touch_;
  int base_body_ = 0;
  int base_q_ = -1, base_dq_ = -1;  // of the free joint; -1 where the base is fixed
  int clamp_ = -1;                  // the equality of the clamp; -1: none
  InertialUnit imu_, secondary_imu_;
  Eigen::Vector3d imu_up_{0, 0, 1};
  std::vector<double> q_, dq_;
  robot::BaseReading base_;
};

}  // namespace understudy::physics
