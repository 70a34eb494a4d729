// A lidar that casts rays through the scene.
#pragma once

#include <cstdint>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "perception/lidar_law.h"
#include "perception/ray_caster.h"
#include "robot/fault.h"
#include "robot/lidar_reading.h"
#include "robot/robot_spec.h"
#include "sensors/sensor_config.h"

namespace understudy::perception {

// The samples up to an instant are cast from the poses of that instant, so that a moving robot's
// cloud is distorted as a real one's. The robot's own limbs are in it.
//
// Which sample has which error depends on the seed and the sample's number alone: a cloud is the
// same whenever a program begins to read. Allocates in the constructor only.
class Lidar {
 public:
  // `body` carries the lidar; geoms of it in which the beams start are its housing, which no ray
  // meets. `data` has the kinematics of the model, that of `rays`. `dt` [s] is the step of the
  // physics.
  Lidar(const robot::LidarSpec& spec, const sensors::SensorConfig& errors, int body,
        const mjModel& model, const mjData& data, const RayCaster& rays, double dt);

  // Goes on with other errors.
  void Apply(const sensors::SensorConfig& errors) { errors_ = errors; }

  // Casts the samples since the step before; `data` has the poses of this one, as `rays` has.
  // `base` is where the robot takes its base for; null: nothing is deskewed. Returns whether a
  // cloud is complete; after Rest the next whole one.
  bool Sense(std::int64_t step, const mjData& data, const RayCaster& rays,
             const robot::LidarEffects& faults = {}, const robot::LegOdometry* base = nullptr);
  // Drops the cloud that has begun.
  void Rest() { sees_ = false; }
  // Reads the lidar's inertial unit after a step of that physics. The body, or one that it
  // carries, must carry an inertial unit of the robot. `noise` has the unit's figures.
  void Feel(std::int64_t step, const mjData& data, const robot::ImuSpec& noise);

  const LidarLaw& law() const { return law_; }
  // Echoes a second if nothing but chance takes any.
  double nominal_points_hz() const {
    return static_cast<double>(law_.cloud_samples) * law_.cloud_hz() * (1 - spec_.dropout);
  }
  // Its cloud is the last complete one, until the next one is.
  robot::LidarReading& reading() { return reading_; }

 private:
  std::int64_t SlotsUntil(std::int64_t step) const { return step * slots_ / steps_; }
  void Begin(std::int64_t slot);
  robot::LidarPoint Cast(std::int64_t slot, const Eigen::Vector3d& ahead, const RayCaster& rays,
                         const robot::LidarEffects& faults) const;

  robot::LidarSpec spec_;
  const LidarLaw& law_;
  sensors::SensorConfig errors_;
  int body_, root_;  // root_: of the tree of bodies
  Eigen::Matrix3d R_BL_;
  std::vector<int> housing_;
  std::int64_t slots_, steps_;     // so many slots in so many steps
  Eigen::Vector3d p_WL_{0, 0, 0};  // m, of this step, as the next
  Eigen::Matrix3d R_WL_;
  robot::LidarReading reading_;
  robot::PointCloud filling_;
  std::vector<robot::LidarPoint> filling_deskewed_;
  bool sees_ = false;
};

}  // namespace understudy::perception
