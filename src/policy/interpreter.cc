#include "policy/interpreter.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/errors.h"
#include "base/nearest_word.h"

namespace understudy::policy {
namespace {

std::size_t MotorAt(std::span<const MotorName> motors, int slot, const std::string& at,
                    const std::string& robot) {
  const auto found = std::ranges::find(motors, slot, &MotorName::slot);
  if (found == motors.end()) {
    throw ConfigError(at + "no motor of " + robot + " is in slot " + std::to_string(slot) +
                      "; it has " + std::to_string(motors.size()) + ", the last in slot " +
                      std::to_string(motors.back().slot));
  }
  return static_cast<std::size_t>(found - motors.begin());
}

std::size_t MotorOf(std::span<const MotorName> motors, const std::string& joint,
                    const std::string& at, const std::string& robot) {
  const auto found = std::ranges::find(motors, joint, &MotorName::joint);
  if (found == motors.end()) {
    std::vector<std::string> joints;
    for (const MotorName& motor : motors) joints.push_back(motor.joint);
    throw ConfigError(at + "no motor of " + robot + " moves a joint '" + joint + "'" +
                      DidYouMean(joint, joints));
  }
  return static_cast<std::size_t>(found - motors.begin());
}

}  // namespace

Interpreter::Interpreter(Definition definition, std::span<const MotorName> motors,
                         const std::string& robot)
    : definition_(std::move(definition)) {
  Bind(motors, robot);
  const auto joints = static_cast<Eigen::Index>(definition_.joints());
  sensed_.q.setZero(joints);
  sensed_.dq.setZero(joints);
  for (const Term& term : definition_.terms) {
    histories_.emplace_back(
        Eigen::MatrixXf::Zero(static_cast<Eigen::Index>(Width(term, definition_)),
                              static_cast<Eigen::Index>(term.history)));
  }
  observation_.setZero(static_cast<Eigen::Index>(Width(definition_)));
  action_.setZero(static_cast<Eigen::Index>(definition_.action.joints.size()));
}

void Interpreter::Bind(std::span<const MotorName> motors, const std::string& robot) {
  for (std::size_t i = 0; i < definition_.joints(); ++i) {
    const auto at = [&](const char* key) {
      return definition_.name + ": " + key + "." + std::to_string(i) + ": ";
    };
    std::size_t motor = 0;
    if (!definition_.joint_names.empty()) {
      motor = MotorOf(motors, definition_.joint_names[i], at("understudy.joint_names"), robot);
    }
    if (!definition_.slots.empty()) {
      const std::size_t in_slot = MotorAt(motors, definition_.slots[i], at("joint_ids_map"), robot);
      if (!definition_.joint_names.empty() && in_slot != motor) {
        throw ConfigError(at("joint_ids_map") + "slot " + std::to_string(definition_.slots[i]) +
                          " of " + robot + " is " + motors[in_slot].joint +
                          "; understudy.joint_names says " + motors[motor].joint);
      }
      motor = in_slot;
    }
    if (std::ranges::count(targets_, motor, &Target::motor) > 0) {
      throw ConfigError(at("joint_ids_map") + motors[motor].joint + " is in the list already");
    }
    const auto slot = static_cast<std::size_t>(motors[motor].slot);
    for (const auto& [key, gains] : {std::pair{"stiffness", &definition_.stiffness},
                                     std::pair{"damping", &definition_.damping}}) {
      if (slot >= gains->size()) {
        throw ConfigError(definition_.name + ": " + key +
                          ": expected a number for each slot up to " + std::to_string(slot) +
                          ", got " + std::to_string(gains->size()));
      }
    }
    targets_.push_back({.motor = motor,
                        .q = definition_.default_q[i],
                        .kp = definition_.stiffness[slot],
                        .kd = definition_.damping[slot]});
  }
}

void Interpreter::Sense(const Sensed& sensed) {
  for (std::size_t i = 0; i < targets_.size(); ++i) {
    const auto joint = static_cast<Eigen::Index>(i);
    const auto motor = static_cast<Eigen::Index>(targets_[i].motor);
    sensed_.q[joint] = sensed.q[motor];
    sensed_.dq[joint] = sensed.dq[motor];
  }
  sensed_.R_WI = sensed.R_WI;
  sensed_.w_WI_I = sensed.w_WI_I;
  sensed_.velocity = sensed.velocity;
}

void Interpreter::Add(std::size_t i) {
  const Term& term = definition_.terms[i];
  Eigen::MatrixXf& history = histories_[i];
  const Eigen::Index last = history.cols() - 1;
  for (Eigen::Index step = 0; step < last; ++step) history.col(step) = history.col(step + 1);
  const std::span<float> values(history.col(last).data(), static_cast<std::size_t>(history.rows()));
  term.row->compute(
      term,
      {.definition = definition_, .sensed = sensed_, .last_action = action_, .phase = &phase_},
      values);
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (definition_.scale_first) values[k] *= term.scale[k];
    if (term.clip) values[k] = std::clamp(values[k], (*term.clip)[0], (*term.clip)[1]);
    if (!definition_.scale_first) values[k] *= term.scale[k];
  }
}

void Interpreter::Assemble() {
  Eigen::Index next = 0;
  const auto put = [&](const auto& values) {
    observation_.segment(next, values.size()) = values;
    next += values.size();
  };
  if (definition_.history_by_step) {
    for (Eigen::Index step = 0; step < histories_.front().cols(); ++step) {
      for (const Eigen::MatrixXf& history : histories_) put(history.col(step));
    }
    return;
  }
  for (const Eigen::MatrixXf& history : histories_) put(history.reshaped());
}

void Interpreter::Begin(const Sensed& sensed) {
  Sense(sensed);
  action_.setZero();
  phase_ = 0;
  for (std::size_t i = 0; i < histories_.size(); ++i) {
    Eigen::MatrixXf& history = histories_[i];
    Add(i);
    const Eigen::Index last = history.cols() - 1;
    for (Eigen::Index step = 0; step < last; ++step) history.col(step) = history.col(last);
  }
}

const Eigen::VectorXf& Interpreter::Observe(const Sensed& sensed) {
  Sense(sensed);
  for (std::size_t i = 0; i < histories_.size(); ++i) Add(i);
  Assemble();
  return observation_;
}

void Interpreter::Act(const Eigen::Ref<const Eigen::VectorXf>& given) {
  action_ = given;
  for (float& value : action_) value = std::isfinite(value) ? value : 0;
  const Action& action = definition_.action;
  for (std::size_t i = 0; i < action.joints.size(); ++i) {
    float& q = targets_[action.joints[i]].q;
    q = action_[static_cast<Eigen::Index>(i)] * action.scale[i] + action.offset[i];
    if (!std::isfinite(q)) q = definition_.default_q[action.joints[i]];
    if (!action.clip.empty()) q = std::clamp(q, action.clip[i][0], action.clip[i][1]);
  }
}

}  // namespace understudy::policy
