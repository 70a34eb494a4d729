// Reads the state of a world as plain values, for observers.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "physics/mujoco_world.h"

namespace understudy::physics {

// Where a body's frame is in the world: x, y, z [m], then the quaternion w, x, y, z.
using BodyPose = std::array<double, 7>;

// The second body is one that moves, so that `force` is what the ground does to a robot.
struct ContactReading {
  std::array<double, 3> at{};     // m, world
  std::array<double, 3> force{};  // N, world, of the first geom on the second
  std::array<int, 2> geoms{};
  std::array<int, 2> bodies{};  // of the geoms
};

std::size_t PositionCount(const MujocoWorld& world);  // of qpos
std::size_t RateCount(const MujocoWorld& world);      // of qvel
// Returns the names of all bodies by MuJoCo's id; the first is the world.
std::vector<std::string> BodyNames(const MujocoWorld& world);

// Each fills `to` up to its size and does not allocate. Positions and rates are those of the next
// step; the others belong to the instant t as described at MujocoWorld.
void ReadPositions(const MujocoWorld& world, std::span<double> to);
void ReadRates(const MujocoWorld& world, std::span<double> to);
void ReadBodies(const MujocoWorld& world, std::span<BodyPose> to);
// Returns how many it filled in: the contacts with a force.
std::size_t ReadContacts(const MujocoWorld& world, std::span<ContactReading> to);
// Returns the centre of mass [m], in the world, of `body` and all that hangs on it, as of the last
// BeginStep: of a base body, the robot's.
std::array<double, 3> SubtreeCenterOfMass(const MujocoWorld& world, int body);

}  // namespace understudy::physics
