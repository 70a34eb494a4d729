// One robot of the simulated world: its base, joints, inertial units and feet.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "robot/robot_spec.h"
#include "robot/robot_values.h"

namespace understudy::physics {

// A robot of a world and where it stands there.
struct PlacedRobot {
  robot::RobotSpec spec;
  std::filesystem::path file{};  // its MJCF
  // Begins all names of the robot in the world's model. "" for the only robot of a world; robots of
  // one world have different ones.
  std::string prefix{};
  double x = 0, y = 0;  // m, where the robot's own origin is in the world
};

// Reads and drives one robot in a World, and sees no other one. `q`, `dq`, base and bodies belong
// to the instant that World says. Allocates in the constructor only.
class RobotBody {
 public:
  // For World, which owns `model` and `data`. The data has the kinematics of joints at zero.
  RobotBody(mjModel* model, mjData* data, const PlacedRobot& robot);

  // Puts the robot at rest over its place in that pose, as high over the ground that is there as
  // the pose says (LiftOntoGround), and lets go of a clamped base. A fixed base stays where its
  // file has it. Everything else stays where it is, and its readings are of that instant.
  void Reset(const robot::PoseSpec& pose);

  // Torques [N·m] of the joints in motor order; finite. They act in the coming steps until others
  // are set or Reset.
  void Drive(std::span<const double> tau);

  // Holds the base where it is now, as a stand does, or lets go. A fixed base is always held.
  void Clamp(bool on);
  bool clamped() const;

  // The world's index of a body of this robot. Throws ModelError when there is none.
  int Body(const std::string& name) const;
  // The same without a throw: -1 when there is none.
  int FindBody(const std::string& name) const;

  // Joint angles [rad] and rates [rad/s] in motor order.
  std::span<const double> q() const { return q_; }
  std::span<const double> dq() const { return dq_; }
  const robot::BaseReading& base() const { return base_; }
  double tilt() const;  // rad between the base's up and the world's
  robot::ImuReading Imu() const { return Read(imu_); }
  // Default where there is none.
  robot::ImuReading SecondaryImu() const { return Read(secondary_imu_); }
  // What the contacts press on each foot [N], in spec order: the part of their normal forces along
  // FootSpec::axis, never negative.
  void FootForces(std::span<double> force) const;
  double weight() const;  // N

  // The world's model, and the robot's description with the names that it has there.
  const mjModel& model() const { return *model_; }
  const robot::RobotSpec& spec() const { return spec_; }

 private:
  friend class World;

  struct ImuAddress {
    int site = -1;
    int gyro = -1;  // in sensordata
    int accel = -1;
  };

  ImuAddress FindImu(const std::string& site, const char* gyro, const char* accel) const;
  robot::ImuReading Read(const ImuAddress& address) const;
  void ReadKinematics();
  void Forget();
  bool has_fixed_base() const { return clamp_ < 0; }

  mjModel* model_;
  mjData* data_;
  std::string prefix_;
  robot::RobotSpec spec_;
  double x_, y_;                             // m
  std::vector<int> q_address_, dq_address_;  // in motor order
  std::vector<int> foot_of_geom_;            // -1 where the geom is no foot's
  std::vector<Eigen::Vector3d> foot_axis_;
  int base_body_ = 0;
  int base_q_ = -1, base_dq_ = -1;  // of the free joint; -1 where the base is fixed
  int clamp_ = -1;                  // likewise
  ImuAddress imu_, secondary_imu_;
  std::vector<double> q_, dq_;
  robot::BaseReading base_;
};

}  // namespace understudy::physics
