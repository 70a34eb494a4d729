#include "physics/forces.h"

#include <algorithm>

#include <mujoco/mujoco.h>

namespace understudy::physics {
namespace {

constexpr double kStiffness = 100;  // 1/s², mjModel.vis.map.stiffness unless a model sets it
constexpr double kDamping = 20;     // 1/s, twice the root of it: critical; *assumed*
constexpr double kHardest = 50;     // m/s², of the mass that is dragged; *assumed*

void AddAll(std::span<const AppliedForce> forces, MujocoWorld* world) {
  for (const AppliedForce& force : forces) world->AddForce(force.body, force.p_WP, force.force_W);
}

}  // namespace

Pushes::Pushes() {
  pushes_.reserve(kMost);
  forces_.reserve(kMost);
}

bool Pushes::Begin(int body, const Eigen::Vector3d& force_W, double until) {
  if (pushes_.size() >= kMost) return false;
  pushes_.push_back({.body = body, .force_W = force_W, .until = until});
  return true;
}

void Pushes::Clear() {
  pushes_.clear();
  forces_.clear();
}

void Pushes::Act(double t, MujocoWorld* world) {
  // Half a step of tolerance: a push of 0.1 s has 100 steps in spite of rounding.
  const double now = t + 0.5 * world->timestep();
  std::erase_if(pushes_, [now](const Push& push) { return now >= push.until; });
  forces_.clear();
  for (const Push& push : pushes_) {
    forces_.push_back({push.body, world->CenterOfMass(push.body), push.force_W});
  }
  AddAll(forces_, world);
}

Drags::Drags() {
  drags_.reserve(kMost);
  forces_.reserve(kMost);
}

bool Drags::Pull(int body, const Eigen::Vector3d& p_BP, const Eigen::Vector3d& p_WT, double until) {
  const Drag drag{.body = body, .p_BP = p_BP, .p_WT = p_WT, .until = until};
  const auto held = std::ranges::find(drags_, body, &Drag::body);
  if (held != drags_.end()) {
    *held = drag;
  } else if (drags_.size() < kMost) {
    drags_.push_back(drag);
  } else {
    return false;
  }
  return true;
}

void Drags::Release(int body) {
  std::erase_if(drags_, [body](const Drag& drag) { return drag.body == body; });
}

void Drags::Clear() {
  drags_.clear();
  forces_.clear();
}

void Drags::Act(double t, MujocoWorld* world) {
  const double now = t + 0.5 * world->timestep();
  std::erase_if(drags_, [now](const Drag& drag) { return now >= drag.until; });
  forces_.clear();
  for (const Drag& drag : drags_) {
    const PointReading point = world->Point(drag.body, drag.p_BP);
    Eigen::Vector3d pull = kStiffness * (drag.p_WT - point.p_WP) - kDamping * point.v_WP_W;
    if (const double hard = pull.norm(); hard > kHardest) pull *= kHardest / hard;
    forces_.push_back({drag.body, point.p_WP, world->SubtreeMass(drag.body) * pull});
  }
  AddAll(forces_, world);
}

}  // namespace understudy::physics
