// The controllers that can play a motion service, one row each.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "authority/motion.h"
#include "motion/transitions.h"
#include "physics/robot_body.h"
#include "robot/robot_spec.h"

namespace understudy::motion {

// What a controller is made of. `spec` and the body's model must outlive it.
struct ControllerParts {
  const robot::RobotSpec& spec;
  const robot::ServiceSpec& service;  // the motion service that it plays
  const physics::RobotBody& body;
  double damping_kd = 0;  // N·m·s/rad, of robots that only damp
};

struct ControllerRow {
  std::string_view name;             // of robot.services[].controller
  StateSet<robot::RobotKind> kinds;  // robots that it can move
  std::string_view is, needs;        // for the documentation
  // Throws ModelError if the model's limbs are of another kind.
  std::unique_ptr<authority::Motion> (*make)(const ControllerParts& parts);
  // Throws ConfigError if the robot's description lacks what it needs; null: it needs nothing.
  void (*check)(const robot::RobotSpec& spec, const robot::ServiceSpec& service) = nullptr;
};

// The first row with a robot's kind is its default controller.
std::span<const ControllerRow> Controllers();

inline constexpr std::string_view kDefaultController = "default";

// Returns kDefaultController and the names of all rows, or of those for a kind.
std::vector<std::string> ControllerNames();
std::vector<std::string> ControllerNames(robot::RobotKind kind);

// Returns null for kDefaultController and unknown names.
const ControllerRow* FindController(std::string_view name);

// Returns what the model lacks for the default controller of its kind, which then only damps; "" if
// it lacks nothing or the service has another controller.
std::string Misfit(const ControllerParts& parts);

// Makes the controller of a motion service, as the service's `controller` says, with the protection
// of motion/protection.h. Never returns null. A robot whose model does not fit its default
// controller only damps (Misfit). Throws ModelError and ConfigError.
std::unique_ptr<authority::Motion> MakeMotion(const ControllerParts& parts);

}  // namespace understudy::motion
