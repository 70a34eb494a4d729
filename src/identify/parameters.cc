#include "identify/parameters.h"

#include <algorithm>
#include <array>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::identify {
namespace {

using Fitted = robot::FittedDynamicsSpec;

// Ranges are *assumed*: wider than any published figure of these robots by a factor of ten.
const std::array<FigureKind, 7> kFigureKinds{{
    {"armature", "kg·m²", 1e-5, 2, true, 0.5, true, "move faster: a higher --to-hz",
     &Fitted::armature},
    {"damping", "N·m·s/rad", 1e-4, 50, true, 0.5, true, "move faster and wider, with a lower kd",
     &Fitted::damping},
    {"frictionloss", "N·m", 1e-4, 50, true, 0.5, true,
     "move slowly, back and forth, with a lower kp", &Fitted::frictionloss},
    {"kd_share", "", 0.01, 10, true, 0.5, false,
     "record with different kd, or command dq: with one kd it is damping", &Fitted::kd_share},
    {"kp_scale", "", 0.05, 20, true, 0.1, false, "record with different kp, some of them low",
     nullptr, &robot::MotorSpec::kp_scale},
    {"mass", "of the link's", 0.1, 10, true, 0.2, false,
     "hold the limb level, in several poses, with a low kp"},
    {"delay", "s", -0.01, 0.06, false, 0.002, true, "command fast movements: a higher --to-hz"},
}};

std::string Bare(const std::string& joint) {
  return joint.ends_with("_joint") ? joint.substr(0, joint.size() - 6) : joint;
}

// What the names of joints end with alike: "hip" of FR_hip_joint and FL_hip_joint.
std::string CommonName(const robot::RobotSpec& spec, const std::vector<std::size_t>& motors) {
  std::string common = Bare(spec.motors[motors.front()].joint);
  for (const std::size_t motor : motors) {
    const std::string name = Bare(spec.motors[motor].joint);
    const auto [end, other] =
        std::mismatch(common.rbegin(), common.rend(), name.rbegin(), name.rend());
    common.erase(common.begin(), end.base());
  }
  if (motors.size() > 1) {
    if (const std::size_t at = common.find('_'); at != std::string::npos) common.erase(0, at + 1);
  }
  return common.empty() ? Bare(spec.motors[motors.front()].joint) + "..." : common;
}

std::vector<Group> GroupsOf(const robot::RobotSpec& spec, bool by_joint) {
  std::vector<Group> groups;
  std::vector<bool> placed(spec.motors.size());
  const auto add = [&](std::vector<std::size_t> motors) {
    if (motors.empty()) return;
    for (const std::size_t motor : motors) placed[motor] = true;
    std::string name = CommonName(spec, motors);
    groups.push_back({.name = std::move(name), .motors = std::move(motors)});
  };
  for (const Fitted& row : spec.dynamics.fitted) {
    std::vector<std::size_t> motors;
    for (std::size_t i = 0; i < spec.motors.size() && !by_joint; ++i) {
      if (!placed[i] && std::ranges::count(row.slots, spec.motors[i].slot) > 0) motors.push_back(i);
    }
    add(std::move(motors));
  }
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    if (!placed[i]) add({i});
  }
  return groups;
}

double KdShareOf(const robot::RobotSpec& spec, int slot) {
  double share = 1;
  for (const Fitted& row : spec.dynamics.fitted) {
    if (std::ranges::count(row.slots, slot) > 0) share = row.kd_share;
  }
  return spec.dynamics.use == robot::DynamicsSource::kFitted ? share : 1;
}

}  // namespace

std::span<const FigureKind> FigureKinds() { return kFigureKinds; }

Basis::Basis(const robot::RobotSpec& robot, const physics::Bench& bench, bool by_joint)
    : spec(robot), groups(GroupsOf(robot, by_joint)) {
  spec.dynamics.use = robot::DynamicsSource::kFitted;
  spec.dynamics.fitted.clear();
  for (const Group& group : groups) {
    const double share = 1 / static_cast<double>(group.motors.size());
    Fitted row{.slots = {}, .armature = 0, .damping = 0, .frictionloss = 0, .kd_share = 0};
    for (const std::size_t motor : group.motors) {
      const physics::JointFigures joint = bench.Joint(motor);
      row.slots.push_back(robot.motors[motor].slot);
      row.armature += share * joint.armature;
      row.damping += share * joint.damping;
      row.frictionloss += share * joint.frictionloss;
      row.kd_share += share * KdShareOf(robot, robot.motors[motor].slot);
    }
    spec.dynamics.fitted.push_back(std::move(row));
  }
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    spec.motors[i].armature = 0;  // now in its row
    links.push_back(bench.Link(i));
  }
}

std::vector<Parameter> Basis::Parameters(const std::vector<std::string>& names,
                                         const physics::Bench& bench) const {
  std::vector<std::string> valid;
  for (const FigureKind& quantity : kFigureKinds) valid.emplace_back(quantity.name);
  for (const std::string& name : names) {
    if (std::ranges::count(valid, name) == 0) {
      throw ConfigError("--parameters: no '" + name + "'" + NearestHint(name, valid));
    }
  }
  std::vector<Parameter> parameters;
  for (const FigureKind& quantity : kFigureKinds) {
    const bool asked = std::ranges::count(names, quantity.name) > 0;
    if (!(names.empty() ? quantity.usual : asked)) continue;
    if (quantity.name == "delay") {
      parameters.push_back({.quantity = &quantity, .before = spec.dynamics.delay});
      continue;
    }
    for (std::size_t i = 0; i < groups.size(); ++i) {
      Parameter parameter{.quantity = &quantity, .group = i, .before = 1};
      if (quantity.fitted != nullptr) parameter.before = spec.dynamics.fitted[i].*quantity.fitted;
      if (quantity.motor != nullptr) {
        parameter.before = spec.motors[groups[i].motors.front()].*quantity.motor;
      }
      for (const std::size_t motor : groups[i].motors) {
        parameter.limbs.push_back(bench.limb(motor));
      }
      parameters.push_back(std::move(parameter));
    }
  }
  return parameters;
}

std::string Basis::NameOf(const Parameter& parameter) const {
  const std::string name(parameter.quantity->name);
  return parameter.group == Parameter::kAll ? name : name + " " + groups[parameter.group].name;
}

Figures Basis::With(std::span<const Parameter> parameters, std::span<const double> values) const {
  Figures figures{.spec = spec,
                  .delay = spec.dynamics.delay,
                  .mass = std::vector<double>(robot::AllMotors(spec).size(), 1.0)};
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FigureKind& quantity = *parameters[i].quantity;
    if (parameters[i].group == Parameter::kAll) {
      figures.delay = values[i];
      continue;
    }
    if (quantity.fitted != nullptr) {
      figures.spec.dynamics.fitted[parameters[i].group].*quantity.fitted = values[i];
      continue;
    }
    for (const std::size_t motor : groups[parameters[i].group].motors) {
      if (quantity.motor != nullptr) {
        figures.spec.motors[motor].*quantity.motor = values[i];
      } else {
        figures.mass[motor] = values[i];
      }
    }
  }
  return figures;
}

}  // namespace understudy::identify
