#include "motion/controllers.h"

#include <algorithm>
#include <utility>

#include "base/errors.h"
#include "motion/damping_motion.h"
#include "motion/humanoid/motion.h"
#include "motion/policy_drive.h"
#include "motion/protection.h"
#include "motion/quadruped/motion.h"

namespace understudy::motion {
namespace {

using robot::RobotKind;
using MotionPtr = std::unique_ptr<authority::Motion>;

MotionPtr MakeQuadruped(const ControllerParts& parts) {
  return std::make_unique<QuadrupedMotion>(parts.spec, ReadQuadruped(parts.body));
}

MotionPtr MakeHumanoid(const ControllerParts& parts) {
  return std::make_unique<HumanoidMotion>(parts.spec, parts.body);
}

// Ids of the vendor: Go2 motion services V2.0, where `mode` is that of firmware before 1.1.6, and
// the humanoids' loco services. That other quadrupeds have the Go2's is *assumed*.
MotionPtr MakeDamping(const ControllerParts& parts) {
  const robot::MotionState quadruped_damped{.id = 1001, .name = "damping", .mode = 7};
  const robot::MotionState humanoid_damped{.id = 1, .name = "damping"};
  const robot::MotionState humanoid_limp{.id = 0, .name = "zero torque"};
  const bool quadruped = robot::IsQuadruped(parts.spec.kind);
  return std::make_unique<DampingMotion>(quadruped ? quadruped_damped : humanoid_damped,
                                         quadruped ? quadruped_damped : humanoid_limp,
                                         parts.damping_kd);
}

MotionPtr MakePolicy(const ControllerParts& parts) {
  auto policy = std::make_unique<PolicyDrive>(parts.spec, parts.service.policy);
  if (parts.spec.kind == RobotKind::kHumanoid) {
    return std::make_unique<HumanoidMotion>(parts.spec, parts.body, std::move(policy));
  }
  return std::make_unique<QuadrupedMotion>(parts.spec, ReadQuadruped(parts.body),
                                           std::move(policy));
}

void CheckPolicy(const robot::RobotSpec& spec, const robot::ServiceSpec& service) {
  if (service.policy.empty()) {
    throw ConfigError("robot.services." + service.name +
                      ".policy: expected the definition that its controller policy plays");
  }
  if (spec.kind == RobotKind::kHumanoid && spec.motion.humanoid.walk.empty()) {
    throw ConfigError("robot.motion.humanoid.walk: expected the states in which the policy of " +
                      service.name + " walks");
  }
  const PolicyDrive drive(spec, service.policy);
}

constexpr ControllerRow kControllers[] = {
    {"quadruped",
     {RobotKind::kQuadruped, RobotKind::kWheeled},
     "model-based: stands, gestures, gets up, trots, rolls",
     "four legs of hip, thigh and calf; robot.motion.quadruped",
     MakeQuadruped},
    {"humanoid",
     {RobotKind::kHumanoid},
     "model-based: stands balanced, walks, squats, moves its arms",
     "two feet with flat soles; robot.motion.humanoid",
     MakeHumanoid},
    {"damping",
     {RobotKind::kOther, RobotKind::kQuadruped, RobotKind::kWheeled, RobotKind::kHumanoid},
     "damps the joints or lets them go limp",
     "nothing",
     MakeDamping},
    {"policy",
     {RobotKind::kQuadruped, RobotKind::kHumanoid},
     "a trained network walks; all other states are those of quadruped or humanoid",
     "robot.services[].policy; on a humanoid robot.motion.humanoid.walk",
     MakePolicy,
     CheckPolicy},
};

const ControllerRow& DefaultRow(RobotKind kind) {
  return *std::ranges::find_if(kControllers,
                               [kind](const ControllerRow& row) { return row.kinds.Has(kind); });
}

MotionPtr MakeDefault(const ControllerParts& parts) {
  try {
    return DefaultRow(parts.spec.kind).make(parts);
  } catch (const ModelError&) {
    return MakeDamping(parts);  // Misfit says why
  }
}

}  // namespace

std::span<const ControllerRow> Controllers() { return kControllers; }

std::vector<std::string> ControllerNames() {
  std::vector<std::string> names{std::string(kDefaultController)};
  for (const ControllerRow& row : kControllers) names.emplace_back(row.name);
  return names;
}

std::vector<std::string> ControllerNames(RobotKind kind) {
  std::vector<std::string> names{std::string(kDefaultController)};
  for (const ControllerRow& row : kControllers) {
    if (row.kinds.Has(kind)) names.emplace_back(row.name);
  }
  return names;
}

const ControllerRow* FindController(std::string_view name) {
  const auto row = std::ranges::find(kControllers, name, &ControllerRow::name);
  return row == std::end(kControllers) ? nullptr : row;
}

std::string Misfit(const ControllerParts& parts) {
  if (FindController(parts.service.controller) != nullptr) return "";
  try {
    DefaultRow(parts.spec.kind).make(parts);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "";
}

MotionPtr MakeMotion(const ControllerParts& parts) {
  const ControllerRow* row = FindController(parts.service.controller);
  return std::make_unique<ProtectedMotion>(parts.spec, parts.body,
                                           row == nullptr ? MakeDefault(parts) : row->make(parts));
}

}  // namespace understudy::motion
