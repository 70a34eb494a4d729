#include "physics/world_reading.h"

#include <algorithm>
#include <utility>

#include <mujoco/mujoco.h>

#include "mjcf/eigen_views.h"

namespace understudy::physics {

std::size_t PositionCount(const MujocoWorld& world) {
  return static_cast<std::size_t>(world.model().nq);
}

std::size_t RateCount(const MujocoWorld& world) {
  return static_cast<std::size_t>(world.model().nv);
}

std::vector<std::string> BodyNames(const MujocoWorld& world) {
  std::vector<std::string> names;
  for (int i = 0; i < world.model().nbody; ++i) {
    const char* name = mj_id2name(&world.model(), mjOBJ_BODY, i);
    names.emplace_back(name == nullptr ? "" : name);
  }
  return names;
}

void ReadPositions(const MujocoWorld& world, std::span<double> to) {
  std::copy_n(world.data().qpos, std::min(to.size(), PositionCount(world)), to.begin());
}

void ReadRates(const MujocoWorld& world, std::span<double> to) {
  std::copy_n(world.data().qvel, std::min(to.size(), RateCount(world)), to.begin());
}

void ReadBodies(const MujocoWorld& world, std::span<BodyPose> to) {
  const mjData& data = world.data();
  const std::size_t count = std::min(to.size(), static_cast<std::size_t>(world.model().nbody));
  for (std::size_t i = 0; i < count; ++i) {
    std::copy_n(data.xpos + 3 * i, 3, to[i].begin());
    std::copy_n(data.xquat + 4 * i, 4, to[i].begin() + 3);
  }
}

std::size_t ReadContacts(const MujocoWorld& world, std::span<ContactReading> to) {
  const mjData& data = world.data();
  std::size_t count = 0;
  for (int i = 0; i < data.ncon && count < to.size(); ++i) {
    const mjContact& contact = data.contact[i];
    if (contact.efc_address < 0) continue;  // near, and left out of the constraints
    mjtNum wrench[6];                       // in the contact's frame, force first
    mj_contactForce(&world.model(), &data, i, wrench);
    ContactReading& reading = to[count++];
    std::copy_n(contact.pos, 3, reading.at.begin());
    const mjcf::RotationView axes(contact.frame);  // in rows
    Eigen::Vector3d force_W = axes.transpose() * Eigen::Map<Eigen::Vector3d>(wrench);
    reading.geoms = {contact.geom1, contact.geom2};
    const int* body = world.model().geom_bodyid;
    reading.bodies = {body[contact.geom1], body[contact.geom2]};
    // MuJoCo sorts the pair by the kind of geom: boxes and meshes come after a robot's spheres.
    if (world.model().body_weldid[reading.bodies[1]] == 0) {
      std::swap(reading.geoms[0], reading.geoms[1]);
      std::swap(reading.bodies[0], reading.bodies[1]);
      force_W = -force_W;
    }
    reading.force = {force_W.x(), force_W.y(), force_W.z()};
  }
  return count;
}

std::array<double, 3> SubtreeCenterOfMass(const MujocoWorld& world, int body) {
  std::array<double, 3> com{};
  std::copy_n(world.data().subtree_com + 3 * body, 3, com.begin());
  return com;
}

}  // namespace understudy::physics
