// A robot that kicks about, in a world and beside it in plain MuJoCo.
#pragma once

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <mujoco/mujoco.h>

#include "physics/mujoco_world.h"

namespace understudy::physics {

// Makes a step of the world with torques on its six joints, and the same step of `whole`, which is
// of `model`, a copy of the world's, by mj_step.
inline void Kick(int step, MujocoWorld* world, const mjModel& model, mjData* whole) {
  const std::vector<robot::MotorSpec>& motors = world->robot().spec().motors;
  std::vector<double> tau(motors.size());
  for (std::size_t i = 0; i < tau.size(); ++i) {
    tau[i] = 3 * std::sin(0.01 * step + static_cast<double>(i));
    const int joint = mj_name2id(&model, mjOBJ_JOINT, motors[i].joint.c_str());
    whole->qfrc_applied[model.jnt_dofadr[joint]] = tau[i];
  }
  mj_step(&model, whole);
  world->BeginStep();
  world->robot().Drive(tau);
  ASSERT_EQ(world->EndStep(), StepHealth::kFine);
}

}  // namespace understudy::physics
