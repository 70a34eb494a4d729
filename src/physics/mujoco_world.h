// Steps the simulated world: robots, their ground and external forces.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "mjcf/mesh_file.h"
#include "mjcf/mujoco_handles.h"
#include "objects/walk.h"
#include "physics/loose_bodies.h"
#include "physics/robot_body.h"

namespace understudy::physics {

// Position and velocity of a point fixed to a body, in the world frame.
struct PointReading {
  Eigen::Vector3d p_WP{0, 0, 0};    // m
  Eigen::Vector3d v_WP_W{0, 0, 0};  // m/s
};

// The result of a step.
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
class MujocoWorld {
 public:
  // `model` comes from LoadWorldModel with the same robots. `nominal` is what it was before chance
  // changed it; null: the same. `memory` is that of a former world of the same files, which this
  // one takes over; null: it gets its own.
  MujocoWorld(mjcf::ModelHandle model, const std::vector<PlacedRobot>& robots,
              mjcf::ModelHandle nominal = nullptr, mjcf::DataHandle memory = nullptr);

  // Ends this world. The next one may have its memory.
  mjcf::DataHandle TakeMemory() && { return std::move(data_); }

  // Has those of the model's objects that have a path walk, and puts everything at rest as Reset
  // does. `objects` are those of LoadWorldModel.
  void Walk(std::span<const objects::ObjectSpec> objects);

  // In the constructor's order. Their addresses stay valid when the world is moved.
  RobotBody& robot(std::size_t i = 0) { return robots_[i]; }
  const RobotBody& robot(std::size_t i = 0) const { return robots_[i]; }

  // Gives rays something to meet in place of mjcf::kScanGround, in the world's frame [m].
  using Scan = std::vector<mjcf::MeshPart>;
  void Show(std::shared_ptr<const Scan> scan) { scan_ = std::move(scan); }
  const Scan* scan() const { return scan_.get(); }  // null: there is none

  // Puts everything at rest in the pose of the model's file; what walks begins its way again.
  void Reset();

  void BeginStep();
  // Applies the external forces set since BeginStep, only in this step.
  [[nodiscard]] StepHealth EndStep();

  // Adds a force [N] on a point fixed to a body, for the next EndStep.
  void AddForce(int body, const Eigen::Vector3d& p_WP, const Eigen::Vector3d& force_W);

  // Gives every contact with the ground this sliding friction, as terrain.friction does, times what
  // chance made of it; 0 gives it back what the model has. Allocates nothing.
  void SetGroundFriction(double friction);
  // Returns the least and the most sliding friction that the ground has now, without the robots'.
  std::array<double, 2> GroundFriction() const;

  // The objects of the world, and one by its name; null if there is none.
  std::span<const LooseBody> objects() const { return objects_; }
  const LooseBody* FindObject(std::string_view name) const;
  // Returns the one that a body belongs to; null if it belongs to none.
  const LooseBody* ObjectOf(int body) const;
  // Of the next step: x, y, z [m] and the quaternion; linear velocity [m/s] in the world, angular
  // [rad/s] in the object's frame.
  std::span<const double> ObjectPosition(const LooseBody& object) const;
  std::span<const double> ObjectVelocity(const LooseBody& object) const;
  // Puts an object at rest upright on a point [m], turned by yaw [rad]. Allocates nothing.
  void PlaceObject(const LooseBody& object, const Eigen::Vector3d& p_WP, double yaw);

  // Returns the index of a body by its name in the world's model, -1 if there is none.
  int FindBody(const std::string& name) const;
  // Returns the centre of mass of that body alone [m], in the world, as of the last BeginStep;
  // SubtreeCenterOfMass (world_reading.h) has that of a robot.
  Eigen::Vector3d CenterOfMass(int body) const;
  double SubtreeMass(int body) const;  // kg, of the body and all that hangs on it
  // Returns position and velocity of the point p_BP [m] of a body.
  PointReading Point(int body, const Eigen::Vector3d& p_BP) const;

  double timestep() const;  // s
  // For tests and viewers.
  const mjModel& model() const { return *model_; }
  const mjData& data() const { return *data_; }

 private:
  // What the model has for a geom of the ground.
  struct Ground {
    int geom;
    double friction;
    double factor;  // by chance
    int priority;
  };

  struct Walker {
    LooseBody body;
    objects::Walk walk;
    double z;       // m, of its origin
    bool has_legs;  // two joints, which come after its own
    double weight;  // N
  };

  bool IsGround(int geom) const;
  void MoveWalkers();

  mjcf::ModelHandle model_, nominal_;
  mjcf::DataHandle data_;
  std::vector<RobotBody> robots_;
  std::vector<LooseBody> objects_;
  std::vector<Walker> walkers_;
  std::int64_t walked_ = 0;  // steps since the last reset
  std::vector<Ground> ground_;
  std::shared_ptr<const Scan> scan_;
};

}  // namespace understudy::physics
