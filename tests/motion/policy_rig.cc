#include "tests/motion/policy_rig.h"

#include <algorithm>
#include <array>

#include "base/files.h"
#include "tests/motion/rig.h"
#include "tests/policy/files.h"

namespace understudy::motion {
namespace {

template <class Of>
std::string ListOf(std::size_t count, const Of& of) {
  std::string text;
  for (std::size_t i = 0; i < count; ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(of(i));
  }
  return "[" + text + "]";
}

policy::Layer Zeros(Eigen::Index outputs, Eigen::Index inputs) {
  return {.weight = Eigen::MatrixXf::Zero(outputs, inputs), .bias = Eigen::VectorXf::Zero(outputs)};
}

Eigen::Index MotorOf(const robot::RobotSpec& spec, const std::string& joint) {
  return std::ranges::find(spec.motors, joint, &robot::MotorSpec::joint) - spec.motors.begin();
}

}  // namespace

PolicyFiles::PolicyFiles(const robot::RobotSpec& spec, const PolicyPose& pose,
                         const std::string& observations, const std::vector<policy::Layer>& layers,
                         const std::string& activation) {
  const std::size_t motors = spec.motors.size();
  const auto listed = [&](const std::vector<double>& values) {
    return ListOf(motors, [&](std::size_t i) { return values[i]; });
  };
  // The slots of both robots here are the places of their motors.
  WriteFile(definition(),
            "joint_ids_map: " + ListOf(motors, [&](std::size_t i) { return spec.motors[i].slot; }) +
                "\nstep_dt: 0.02\nstiffness: " + listed(pose.kp) + "\ndamping: " + listed(pose.kd) +
                "\ndefault_joint_pos: " + listed(pose.q) +
                "\ncommands: {base_velocity: {ranges: {lin_vel_x: [-1, 1], lin_vel_y: [-1, 1], "
                "ang_vel_z: [-1, 1]}}}\n"
                "actions: {JointPositionAction: {scale: " +
                policy::Repeated(motors, "1") + ", offset: " + listed(pose.q) +
                "}}\nobservations:\n" + observations);
  WriteFile(weights(), policy::TensorBytes(policy::FileOf(layers, activation)));
}

void PolicyFiles::Change(const std::string& from, const std::string& to) const {
  std::string text = FileText(definition());
  text.replace(text.find(from), from.size(), to);
  WriteFile(definition(), text);
}

std::vector<std::string> Plays(const std::string& service, const PolicyFiles& policy) {
  return {"robot.services." + service + ".controller=policy",
          "robot.services." + service + ".policy=" + policy.definition()};
}

PolicyFiles TrotOfGo2() {
  constexpr Eigen::Index kSin = 0, kCos = 1, kAhead = 2;
  // Swing of the pair FR RL and its negative, lift of this pair and of the other one.
  policy::Layer hidden = Zeros(4, 5);
  for (const Eigen::Index unit : {0, 1}) {
    hidden.weight(unit, kSin) = unit == 0 ? 1 : -1;
    hidden.weight(unit, kAhead) = 1;
    hidden.bias[unit] = -1;
  }
  for (const Eigen::Index unit : {2, 3}) {
    hidden.weight(unit, kCos) = unit == 2 ? 1 : -1;
    hidden.weight(unit, kAhead) = 2;
    hidden.bias[unit] = -1;
  }
  constexpr float kSwing = 0.5F, kLift = 0.5F;  // rad
  policy::Layer last = Zeros(12, 4);
  for (const Eigen::Index leg : {0, 1, 2, 3}) {
    const bool first = leg == 0 || leg == 3;
    const Eigen::Index thigh = 3 * leg + 1, calf = 3 * leg + 2, lift = first ? 2 : 3;
    last.weight(thigh, 0) = first ? -kSwing : kSwing;
    last.weight(thigh, 1) = -last.weight(thigh, 0);
    last.weight(thigh, lift) = kLift / 2;
    last.weight(calf, lift) = -kLift;
  }
  const robot::RobotSpec spec = ConfigOf("go2").robots[0].spec;
  return {spec,
          {.q = spec.standing.q, .kp = std::vector(12, 60.0), .kd = std::vector(12, 2.0)},
          "  gait_phase: {params: {period: 0.4}}\n  velocity_commands: {params: {}}\n",
          {hidden, last},
          "relu"};
}

PolicyFiles StandOfG1() {
  const robot::RobotSpec spec = ConfigOf("g1").robots[0].spec;
  constexpr Eigen::Index kRollRate = 0, kPitchRate = 1, kGravity = 3, kTurn = 8;
  policy::Layer layer = Zeros(static_cast<Eigen::Index>(spec.motors.size()), 9);
  PolicyPose pose{.q = spec.standing.q, .kp = {}, .kd = {}};
  for (std::size_t i = 0; i < spec.motors.size(); ++i) {
    constexpr std::array kLegKp{150, 150, 100, 200, 80, 80};
    constexpr std::array kLegKd{3, 3, 2, 4, 4, 4};
    pose.kp.push_back(i < 12 ? kLegKp[i % 6] : i < 15 ? 200 : 40);
    pose.kd.push_back(i < 12 ? kLegKd[i % 6] : i < 15 ? 5 : 2);
  }
  for (const std::string side : {"left", "right"}) {
    const Eigen::Index pitch = MotorOf(spec, side + "_ankle_pitch_joint");
    const Eigen::Index roll = MotorOf(spec, side + "_ankle_roll_joint");
    layer.weight(pitch, kGravity) = 1.5F;  // gravity points ahead in a base that leans ahead
    layer.weight(pitch, kPitchRate) = 0.15F;
    layer.weight(roll, kGravity + 1) = -0.5F;
    layer.weight(roll, kRollRate) = 0.05F;
    pose.q[static_cast<std::size_t>(pitch)] = -0.14;
  }
  layer.weight(MotorOf(spec, "waist_yaw_joint"), kTurn) = 0.5F;
  return {spec,
          pose,
          "  base_ang_vel: {params: {}}\n  projected_gravity: {params: {}}\n"
          "  velocity_commands: {params: {}}\n",
          {layer},
          "none"};
}

}  // namespace understudy::motion
