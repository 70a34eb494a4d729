// Finds the objects of a world: bodies that move freely and belong to no robot.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <Eigen/Core>

#include "mjcf/mujoco_handles.h"
#include "physics/robot_body.h"

namespace understudy::physics {

struct LooseBody {
  std::string name;
  int body = 0;
  std::size_t q = 0, v = 0;  // where its joint begins in qpos and qvel
  double foot = 0;           // m: its origin above its lowest point as it stands upright
  bool walks = false;        // along its path; nothing else moves it
};

// Returns them in the order of the model; those without a name are left out.
std::vector<LooseBody> FindLooseBodies(const mjModel& model, std::span<const RobotBody> robots);

// Puts a body at rest upright on the point p_WP [m], turned by yaw [rad], and has the kinematics
// follow. Allocates nothing.
void Place(const LooseBody& loose, const Eigen::Vector3d& p_WP, double yaw, const mjModel& model,
           mjData* data);

}  // namespace understudy::physics
