// The description of a robot's motion service: robot.motion of its YAML file. Each field is a YAML
// key of the same name; config/motion_keys.cc reads it and has its meaning, unit and range.
#pragma once

#include <array>
#include <vector>

#include <Eigen/Core>

#include "robot/protection.h"

namespace understudy::robot {

// How a humanoid steps. Axes of the vectors are forward and left m/s, turn rad/s.
struct StepSpec {
  double time = 0;           // s of a step; 0: derived from the robot's height
  double foot_raise = 0.08;  // m that a swinging foot is lifted by
  Eigen::Vector3d least_speed{-0.3, -0.25, -0.6};  // what it takes of a command
  Eigen::Vector3d most_speed{0.6, 0.25, 0.6};      // most of the same
};

// The states of a humanoid's motion service, by the vendor's ids; -1 or empty if the robot has no
// such state.
struct HumanoidMotionSpec {
  int lock_stand = -1;            // joints locked, standing
  std::vector<int> balance{};     // stands balanced and walks; the first is the default
  int squat = -1;                 // joints locked in squat_q
  int sit = -1;                   // joints locked in sit_q
  int arms_balance = -1;          // told for the first of `balance` while rt/arm_sdk moves the arms
  int protection = -1;            // told in place of damping while protection damps
  int balanced_squat = -1;        // from standing into squat_q and back, balanced
  std::vector<int> walk{};        // walks by the controller policy; without it unplayed
  std::vector<int> unplayed{};    // of the real robot, not simulated
  std::vector<double> squat_q{};  // rad, motor order
  std::vector<double> sit_q{};
  bool stand_heights = true;  // whether a request for a stand height has an effect
  bool arm_actions = false;   // waves, shakes hands ...
  StepSpec steps{};
};

// How a quadruped walks. Axes of the vectors are forward and left m/s, turn rad/s.
struct WalkSpec {
  std::array<double, 2> period = {0.5, 0.5};  // s of a stride, at rest and at most_speed forwards
  std::array<double, 2> duty = {0.55,
                                0.55};  // part of the stride that a foot stands, at the same speeds
  double foot_raise = 0.08;             // m that a swinging foot is lifted by
  double friction = 0.5;                // of the ground that it counts on
  Eigen::Vector3d least_speed{-1, -0.4, -1};     // least that it takes of a command
  Eigen::Vector3d most_speed{1, 0.4, 1};         // most that it takes of a command
  Eigen::Vector3d dead_band{0, 0, 0};            // commands within are none
  Eigen::Vector3d gain{1, 1, 1};                 // of the velocity on the command
  Eigen::Vector3d time_constant{0.4, 0.4, 0.4};  // s in which the velocity follows
  double dead_time = 0;                          // s until it begins to
  double turn_scrub = 1;                         // of wheels: how much faster they run in a turn
  // When in a stride FR FL RR RL touch down, 0 to 1: the gait's, no key.
  std::array<double, 4> offsets = {0, 0.5, 0.5, 0};
};

// The parameters of a quadruped's motion service.
struct QuadrupedMotionSpec {
  double stand_height = 0;                      // m, of the base over the ground
  bool stands_up = false;                       // by itself, when its service starts
  bool gestures_from_lock = false;              // and Sit and Pose: balances first
  double foot_x = 0;                            // m, of the feet ahead of the hips
  std::array<double, 2> height_range = {0, 0};  // m about stand_height
  Eigen::Vector3d euler_range{0, 0, 0};         // rad either way: roll, pitch, yaw
  Eigen::Vector3d sit{0, 0, 0};  // m ahead, m over stand_height, rad of pitch: of the base
  double kp = 1;                 // N·m/rad at the legs' joints
  double kd = 0;                 // N·m·s/rad
  double damping_kd = 0;         // N·m·s/rad when damped, at all joints
  double wheel_kp = 0;           // N·m/rad, holds the wheels of a balanced robot
  double wheel_kd = 0;           // N·m·s/rad, brakes them
  WalkSpec walk;
};

// The parameters of the motion service.
struct MotionSpec {
  ProtectionSpec protection;
  HumanoidMotionSpec humanoid;
  QuadrupedMotionSpec quadruped;
};

}  // namespace understudy::robot
