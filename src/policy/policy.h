// A policy: observations, network and action, as the definition has them.
#pragma once

#include <span>
#include <string>

#include <Eigen/Core>

#include "policy/definition.h"
#include "policy/interpreter.h"
#include "policy/network.h"

namespace understudy::policy {

// Computes the targets of the motors from what is sensed. Allocates only in the constructor.
class Policy {
 public:
  // As Interpreter. Throws ConfigError also if the network does not fit the definition.
  Policy(Definition definition, Network network, std::span<const MotorName> motors,
         const std::string& robot);

  const Definition& definition() const { return interpreter_.definition(); }
  const Network& network() const { return network_; }

  // As Interpreter's.
  void Begin(const Sensed& sensed) { interpreter_.Begin(sensed); }
  std::span<const Target> targets() const { return interpreter_.targets(); }
  const Eigen::VectorXf& observation() const { return interpreter_.observation(); }
  const Eigen::VectorXf& action() const { return interpreter_.action(); }

  // One step; call it every definition().step_dt seconds.
  void Step(const Sensed& sensed) { interpreter_.Act(network_.Run(interpreter_.Observe(sensed))); }

 private:
  Interpreter interpreter_;
  Network network_;
};

// Throws ConfigError if the network does not take the observations or give the actions.
void CheckWidths(const Definition& definition, const Network& network);

// Reads the definition and its weights and makes the policy. Throws ConfigError.
Policy LoadPolicy(const std::filesystem::path& definition, std::span<const MotorName> motors,
                  const std::string& robot);

}  // namespace understudy::policy
