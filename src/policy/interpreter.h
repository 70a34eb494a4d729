// What a definition says of a robot: the observations of its policy and what an action does.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "policy/definition.h"
#include "policy/terms.h"

namespace understudy::policy {

// A motor of the robot, for Interpreter.
struct MotorName {
  std::string joint;
  int slot = 0;  // in LowCmd
};

// The command to one motor; its dq and torque are 0.
struct Target {
  std::size_t motor = 0;  // motor order
  float q = 0;            // rad
  float kp = 0;           // N·m/rad
  float kd = 0;           // N·m·s/rad
};

// Computes what the network gets and the targets of the motors, bit for bit as the vendor's program
// does. The network is the caller's. Allocates only in the constructor.
class Interpreter {
 public:
  // `motors` are those of the robot in motor order, `robot` is its name for errors. Throws
  // ConfigError if the definition does not fit them.
  Interpreter(Definition definition, std::span<const MotorName> motors, const std::string& robot);

  const Definition& definition() const { return definition_; }

  // Begins anew: the last action is 0, and all steps of each history are as now. Vectors of
  // `sensed` are in motor order.
  void Begin(const Sensed& sensed);

  // Makes one step of the observations; call it every definition().step_dt seconds.
  const Eigen::VectorXf& Observe(const Sensed& sensed);
  // Follows the network's answer, which has a number for each action; one that is not finite counts
  // as 0.
  void Act(const Eigen::Ref<const Eigen::VectorXf>& action);

  // Of the last Act, in the policy's order: of joints without an action the default angle.
  std::span<const Target> targets() const { return targets_; }
  // Of the last Observe and of the last Act.
  const Eigen::VectorXf& observation() const { return observation_; }
  const Eigen::VectorXf& action() const { return action_; }

 private:
  void Bind(std::span<const MotorName> motors, const std::string& robot);
  void Sense(const Sensed& sensed);
  void Add(std::size_t term);  // the newest step of its history
  void Assemble();

  Definition definition_;
  std::vector<Target> targets_;
  Sensed sensed_;  // in the policy's order
  float phase_ = 0;
  std::vector<Eigen::MatrixXf> histories_;  // by term: values by steps, the newest last
  Eigen::VectorXf observation_, action_;
};

}  // namespace understudy::policy
