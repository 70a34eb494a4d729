// What a quadruped's controller needs to know of its body, read once from the compiled model: where
// its legs turn, how long they are, what they weigh.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// A lump of mass fixed to a frame.
struct LinkMass {
  double mass = 0;               // kg
  Eigen::Vector3d com{0, 0, 0};  // m, in the frame of the link
  // kg·m², about the centre of mass, along the link's axes.
  Eigen::Matrix3d inertia = Eigen::Matrix3d::Zero();
};

// What a point of that mass at p [m] adds to the inertia about the origin, kg·m².
Eigen::Matrix3d PointInertia(double mass, const Eigen::Vector3d& p);

// All within `rounding` of a box along the base's axes, m.
struct TrunkShape {
  Eigen::AlignedBox3d box;
  double rounding = 0;
};

// A leg of three hinges: hip about x, thigh and calf about y, all zero with the leg straight down.
// Each frame is parallel to the base's at zero.
struct LegFigures {
  Eigen::Vector3d hip{0, 0, 0};         // m, the hip's origin in the base
  Eigen::Vector3d thigh{0, 0, 0};       // the thigh's in the hip
  Eigen::Vector3d calf{0, 0, 0};        // the calf's in the thigh
  Eigen::Vector3d foot{0, 0, 0};        // centre of the foot's ball or tyre in the calf
  double radius = 0;                    // m, of that ball or tyre
  double half_width = 0;                // m, of a tyre, whose axis is the calf's y; a ball's is 0
  std::array<LinkMass, 3> links;        // hip, thigh, calf with all that hangs on it
  std::array<double, 3> low{}, high{};  // rad, range of the joints
  // Of motors and joints: kg·m², N·m·s/rad, N·m.
  Eigen::Vector3d armature{0, 0, 0}, damping{0, 0, 0}, friction{0, 0, 0};
};

struct QuadrupedFigures {
  LinkMass trunk;
  std::vector<TrunkShape> trunk_shapes;  // what of the trunk can touch the ground
  std::array<LegFigures, 4> legs;        // FR FL RR RL
  Eigen::Quaterniond R_BI{1, 0, 0, 0};
  Eigen::Vector3d p_BI{0, 0, 0};  // m, the inertial unit in the base
  bool wheeled = false;           // motors 12 to 15 turn wheels FR FL RR RL
  double mass = 0;                // kg, of everything
  double gravity = 9.81;          // m/s²
};

// Reads a robot from its model. The first twelve motors must be the legs' FR FL RR RL, each hip,
// thigh, calf, and the description's feet the feet. Throws ModelError, naming the joint, where the
// model's legs are of another kind.
QuadrupedFigures ReadQuadruped(const physics::RobotBody& robot);

}  // namespace understudy::motion
