// The lidar of a robot, and the programs on its computer that make maps of what it sees.
#pragma once

#include <cstdint>
#include <vector>

#include "emulator/computer.h"
#include "perception/clearance.h"
#include "perception/height_mapper.h"
#include "perception/lidar.h"
#include "perception/obstacle_map.h"
#include "perception/ray_caster.h"
#include "perception/voxel_mapper.h"
#include "physics/mujoco_world.h"
#include "robot/rate.h"
#include "wire/robot_topics.h"

namespace understudy::emulator {

// Nothing is computed that nobody reads. Allocates in the constructor, and for a map of voxels when
// the first reader comes.
class Eyes {
 public:
  // `spec` has a lidar and must outlive it.
  Eyes(const robot::RobotSpec& spec, const sensors::SensorConfig& errors,
       const physics::MujocoWorld& physics, const physics::RobotBody& body,
       const perception::RayCaster& rays);

  // Goes on with other errors.
  void Apply(const sensors::SensorConfig& errors) { lidar_.Apply(errors); }
  // Looks after a step of the physics and publishes what is complete or due.
  void Look(std::int64_t step, const mjData& data, const robot::LidarEffects& faults,
            perception::RayCaster* rays, Computer* computer);

 private:
  // A content, and how often it is due; of those of clouds with each cloud.
  struct Part {
    wire::Content content;
    robot::Rate rate;
    bool wanted = false;
  };

  bool Wants(wire::Content content) const;
  void Rest();
  void Cast(std::int64_t step, const mjData& data, const robot::LidarEffects& faults,
            perception::RayCaster* rays, Computer* computer);
  // Make of a cloud that is complete what is wanted of it.
  void Map(const robot::LegOdometry& base);
  void Measure(const robot::LegOdometry& base);
  void FindObstacles(const robot::LegOdometry& base, Computer* computer);
  void ForgetObstacles(Computer* computer);
  Eigen::Vector3d InBase(const robot::LidarPoint& point) const;

  const robot::RobotSpec& spec_;
  std::int64_t step_ns_;
  Eigen::Matrix3d R_BL_;
  perception::Lidar lidar_;
  perception::HeightMapper heights_;
  perception::VoxelMapper voxels_;
  perception::Clearance clearance_;
  perception::ObstacleMap obstacles_;
  robot::SeenObstacles seen_;
  std::vector<Part> parts_;
  bool mapped_ = false;  // the map of heights has something
  bool looks_ = false;   // for obstacles
};

}  // namespace understudy::emulator
