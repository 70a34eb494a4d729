// Reads the state of a world as plain values, for observers.
#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "physics/world.h"

namespace understudy::physics {

// Where a body's frame is in the world: x, y, z [m], then the quaternion w, x, y, z.
using BodyPose = std::array<double, 7>;

struct ContactReading {
  std::array<double, 3> at{};     // m, world
  std::array<double, 3> force{};  // N, world, of the first geom on the second
  std::array<int, 2> geoms{};
  std::array<int, 2> bodies{};  // that those belong to
};

std::size_t PositionCount(const World& world);  // of qpos
std::size_t RateCount(const World& world);      // of qvel
// Of all bodies, by MuJoCo's id; the first is the world's own.
std::vector<std::string> BodyNames(const World& world);

// Each fills as much as `to` holds and allocates nothing. Positions and rates are those of the
// step to come; the rest belongs to the instant t as World says.
void ReadPositions(const World& world, std::span<double> to);
void ReadRates(const World& world, std::span<double> to);
void ReadBodies(const World& world, std::span<BodyPose> to);
// Returns how many it filled: the contacts that press.
std::size_t ReadContacts(const World& world, std::span<ContactReading> to);
// Of all that is below `body`, itself included [m].
std::array<double, 3> SubtreeCenterOfMass(const World& world, int body);

}  // namespace understudy::physics
