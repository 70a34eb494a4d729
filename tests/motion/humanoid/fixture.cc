#include "tests/motion/humanoid/fixture.h"

#include <algorithm>
#include <cctype>
#include <numeric>

#include <mujoco/mujoco.h>

namespace understudy::motion {

config::Config HumanoidConfig(const std::string& robot, double timestep) {
  const std::size_t space = robot.find(' ');
  std::vector<std::string> settings;
  if (space != std::string::npos) {
    const std::string choice = robot.substr(space + 1);
    const bool is_revision = std::isdigit(static_cast<unsigned char>(choice[0])) != 0;
    settings = {(is_revision ? "robot.revision=" : "robot.hand_make=") + choice};
  }
  config::Config config = ConfigOf(robot.substr(0, space), settings);
  config.physics.timestep = timestep;
  return config;
}

void HumanoidRig::SetDown(int id) {
  const int lock_stand = spec().motion.humanoid.lock_stand;
  Start("hanging");
  SetFsm(1);
  SetFsm(lock_stand);
  Run(5);
  robot().crane().Lower(0.4);
  Run(4.5);
  if (id != lock_stand) {
    SetFsm(id);
    Run(1);
  }
  robot().crane().Release();
}

double HumanoidRig::Load() const {
  std::vector<double> force(spec().feet.size());
  world().robot().FootForces(force);
  return std::accumulate(force.begin(), force.end(), 0.0);
}

double HumanoidRig::DeepestSelfContact() const {
  double deepest = 0;
  for (int i = 0; i < world().data().ncon; ++i) {
    const mjContact& contact = world().data().contact[i];
    if (world().model().geom_bodyid[contact.geom1] == 0) continue;
    if (world().model().geom_bodyid[contact.geom2] == 0) continue;
    deepest = std::max(deepest, -contact.dist);
  }
  return deepest;
}

double HumanoidRig::q(const std::string& joint) const {
  const auto found = std::ranges::find(spec().motors, joint, &robot::MotorSpec::joint);
  return world().robot().q()[static_cast<std::size_t>(found - spec().motors.begin())];
}

}  // namespace understudy::motion
