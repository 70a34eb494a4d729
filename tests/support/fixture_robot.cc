#include "tests/support/fixture_robot.h"

#include <mujoco/mujoco.h>

#include "physics/world_model.h"

namespace understudy::test {

robot::RobotSpec FixtureRobot() {
  robot::RobotSpec spec;
  spec.name = "fixture";
  spec.model = FixtureFile("fixture_robot.xml").string();
  spec.base_body = "base";
  spec.kind = robot::RobotKind::kQuadruped;
  spec.motor_types = {{.name = "fixture",
                       .watt_per_nm2 = 0.1,
                       .winding_c_per_w = 0.2,
                       .casing_c_per_w = 0.8,
                       .winding_time = 10,
                       .casing_time = 100}};
  const auto add = [&spec](const char* joint, int slot) {
    spec.motors.push_back({.joint = joint,
                           .slot = slot,
                           .torque_limit = 50,
                           .type = "fixture",
                           .q_step = 1.0 / 4096,
                           .dq_step = 1.0 / 64,
                           .tau_step = 1.0 / 32,
                           .hold_kp = 200,
                           .hold_kd = 5});
  };
  add("FR_joint", 0);
  add("FL_joint", 1);
  add("RR_joint", 3);
  add("RL_joint", 4);
  add("neck_pitch_joint", 6);
  add("neck_roll_joint", 7);
  for (const std::size_t neck : {4U, 5U}) spec.motors[neck].torque_limit = 100;
  spec.parallel = {{.pitch = 4, .roll = 5, .roll_ratio = 2}};
  spec.imu.site = "imu";
  spec.imu.secondary_site = "head_imu";
  spec.imu.gyro_step = 1.0 / 1024;
  spec.imu.accel_step = 1.0 / 256;
  spec.imu.temperature_c = 40;
  for (const char* foot : {"FR", "FL", "RR", "RL"}) {
    spec.feet.push_back({.name = foot, .geoms = {std::string(foot) + "_foot"}});
  }
  spec.battery = {.cells = 10,
                  .capacity_ah = 1,
                  .cell_v = {3, 3.1, 3.2, 3.3, 3.4, 3.5, 3.6, 3.7, 3.8, 3.9, 4},
                  .internal_ohm = 0.1,
                  .idle_a = 1,
                  .cell_spread = 0};
  spec.thermal = {.ambient_c = 20, .rest_rise_c = 5};
  spec.lying = {.q = {1.5, 1.5, 1.5, 1.5, 0, 0}, .height = 0.06};
  spec.standing = {.q = {0, 0, 0, 0, 0, 0}, .height = 0.3};
  spec.hanging = {.q = {0, 0, 0, 0, 0, 0}, .height = 1};
  spec.crane_body = "base";
  spec.crane_point = {0, 0, 0.1};
  spec.default_start = "lying";
  return spec;
}

robot::RobotSpec FixtureRobotWithHand() {
  robot::RobotSpec spec = FixtureRobot();
  robot::HandSpec hand{.name = "neck", .topic = "neck", .timeout = 0.1};
  for (const std::size_t i : {5U, 4U}) {
    spec.motors[i].torque_limit = 5;
    spec.motors[i].lock_kd = 1;
    hand.motors.push_back(spec.motors[i]);
  }
  spec.hands = {hand};
  spec.motors.resize(4);
  spec.parallel.clear();
  for (robot::PoseSpec* pose : {&spec.lying, &spec.standing, &spec.hanging}) pose->q.resize(4);
  return spec;
}

config::Config FixtureConfig() {
  config::Config config;
  config.robots[0].sensors = {.quantise = false, .noise = false};
  config.robots[0].spec = FixtureRobot();
  return config;
}

physics::MujocoWorld FixtureWorld(const robot::RobotSpec& spec, double timestep) {
  return {
      physics::LoadWorldModel({{spec, spec.model}}, FixtureFile("fixture_ground.xml"), timestep),
      {{spec}}};
}

std::filesystem::path FixtureFile(const std::string& name) {
  return std::filesystem::path(UNDERSTUDY_SOURCE_DIR) / "tests" / "data" / name;
}

std::vector<std::string> MotorOrder(const robot::RobotSpec& spec) {
  std::vector<std::string> names;
  for (const robot::MotorSpec& motor : spec.motors) names.push_back(motor.joint);
  return names;
}

std::vector<std::string> JointOrder(const mjModel& model) {
  std::vector<std::string> names;
  for (int i = 0; i < model.njnt; ++i) {
    if (model.jnt_type[i] == mjJNT_FREE) continue;
    names.emplace_back(mj_id2name(&model, mjOBJ_JOINT, i));
  }
  return names;
}

std::vector<std::string> ActuatorOrder(const mjModel& model) {
  std::vector<std::string> names;
  for (int i = 0; i < model.nu; ++i) {
    names.emplace_back(mj_id2name(&model, mjOBJ_JOINT, model.actuator_trnid[2 * i]));
  }
  return names;
}

std::vector<double> Hold(const physics::RobotBody& robot, const std::vector<double>& q) {
  std::vector<double> tau;
  for (std::size_t i = 0; i < q.size(); ++i) {
    tau.push_back(200 * (q[i] - robot.q()[i]) - 5 * robot.dq()[i]);
  }
  return tau;
}

}  // namespace understudy::test
