// A robot on a stand, in a world of its own that can be put into any state of its joints and given
// any figures of them: for finding those that a recording fits.
#pragma once

#include <array>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "physics/mujoco_world.h"

namespace understudy::physics {

// What a joint has in the model.
struct JointFigures {
  double armature = 0;      // kg·m²
  double damping = 0;       // N·m·s/rad
  double frictionloss = 0;  // N·m
};

// Mass and inertia of a body.
struct BodyFigures {
  std::string name{};
  double mass = 0;                // kg
  std::vector<double> com{};      // m, centre of mass in the body's frame
  std::vector<double> inertia{};  // kg·m², xx yy zz xy xz yz about it, in the body's frame
};

// Nothing touches anything: there are no contacts. Allocates in the constructor and in Use.
class Bench {
 public:
  // Compiles the robot with its base clamped as it hangs. Throws as LoadWorldModel.
  Bench(const PlacedRobot& robot, const std::filesystem::path& scene, double timestep);

  // Gives the joints what `spec` says of them, which may differ from the constructor's in
  // `dynamics` and in the motors' `armature` only, and multiplies mass and inertia of each motor's
  // link by `mass`, in motor order; none: as it is.
  void Use(const robot::RobotSpec& spec, std::span<const double> mass = {});

  // Puts the joints at angles [rad] and rates [rad/s], in motor order, and the base at rest.
  void Start(std::span<const double> q, std::span<const double> dq);

  double mass() const { return world_.robot().weight() / -world_.robot().gravity().z(); }  // kg
  std::vector<std::array<double, 2>> ranges() const { return world_.robot().ranges(); }

  RobotBody& robot() { return world_.robot(); }
  MujocoWorld& world() { return world_; }

  // Of the joint of a motor; and of the link that it moves.
  JointFigures Joint(std::size_t motor) const;
  BodyFigures Link(std::size_t motor) const;
  // Which limb a motor moves, from 0: motors of different limbs do not feel one another, as the
  // base is clamped.
  std::size_t limb(std::size_t motor) const { return limbs_[motor]; }

 private:
  struct Place {
    int dof = 0, body = 0;
    JointFigures joint{};
    double mass = 0;
    std::vector<double> inertia{};
  };

  mjModel* model_;  // the world's
  MujocoWorld world_;
  std::vector<Place> places_;  // in motor order, as compiled
  std::vector<std::size_t> limbs_;
  robot::PoseSpec pose_;
};

}  // namespace understudy::physics
