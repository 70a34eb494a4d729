// The simulated world: robots on their ground, and what moves them. Nothing outside this folder and
// mjcf/ sees MuJoCo.
#pragma once

#include <string>
#include <vector>

#include "mjcf/mujoco_handles.h"
#include "physics/robot_body.h"

namespace understudy::physics {

// A point fixed to a body, as it is now, in the world frame.
struct PointReading {
  Eigen::Vector3d p_WP{0, 0, 0};    // m
  Eigen::Vector3d v_WP_W{0, 0, 0};  // m/s
};

// How a step went.
enum class StepHealth {
  kFine,
  kDiverged,  // a position, rate or acceleration was not finite or beyond reason; the world now
              // holds no valid state
};

// Advances by fixed steps, split so that the motor law sits between positions and forces:
//
//   BeginStep()   kinematics at t: the robots' q(), dq() and base(), and Point() are of t
//                 here robots are driven (RobotBody::Drive) and bodies pushed (AddForce)
//   EndStep()     forces at t, then the state of t + dt; Imu() and FootForces() are of t
//
// Between EndStep and the next BeginStep every reading still belongs to t. After a robot's Reset
// and before the first BeginStep readings are those of the start state; before Reset that is the
// pose of the model's file. Allocates in the constructor only.
class World {
 public:
  // `model` comes from LoadWorldModel with the same robots.
  World(mjcf::ModelHandle model, const std::vector<PlacedRobot>& robots);

  // In the constructor's order. Their addresses stay valid when the world is moved.
  RobotBody& robot(std::size_t i = 0) { return robots_[i]; }
  const RobotBody& robot(std::size_t i = 0) const { return robots_[i]; }

  // Puts everything where the model's file has it, at rest.
  void Reset();

  void BeginStep();
  // External forces set before act in this step and are then gone.
  [[nodiscard]] StepHealth EndStep();

  // A force [N] on a point that is fixed to a body, for the coming EndStep. Adds up.
  void AddForce(int body, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W);

  // Index of a body by its name in the world's model, -1 when there is none.
  int FindBody(const std::string& name) const;
  Eigen::Vector3d CenterOfMass(int body) const;  // m, world; as of the last BeginStep
  double SubtreeMass(int body) const;            // kg, of the body and all that hangs on it
  // The point p [m] in the frame of a body.
  PointReading Point(int body, const Eigen::Vector3d& p_BP) const;

  double timestep() const;  // s
  // For a test or a viewer to copy from; never to write.
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 private:
  mjcf::ModelHandle model_;
  mjcf::DataHandle data_;
  std::vector<RobotBody> robots_;
};

}  // namespace understudy::physics
