// The observations that a policy can have, one row each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "policy/definition.h"

namespace understudy::policy {

// What a policy senses at one instant, as LowState has it: float32.
struct Sensed {
  Eigen::VectorXf q, dq;                // rad, rad/s
  Eigen::Quaternionf R_WI{1, 0, 0, 0};  // attitude of LowState's IMU
  Eigen::Vector3f w_WI_I{0, 0, 0};      // rad/s, its gyroscope
  Eigen::Vector3f velocity{0, 0, 0};    // commanded: forward, left m/s, turn rad/s
};

// What terms are computed from.
struct TermInput {
  const Definition& definition;
  const Sensed& sensed;  // q and dq in the policy's order
  const Eigen::VectorXf& last_action;
  float* phase;  // of the gait, 0 to 1; kept from step to step
};

struct TermRow {
  enum class Width : std::uint8_t { kTwo, kThree, kJoints, kActions };

  std::string_view name;
  std::string_view is;  // for the documentation, with its unit
  Width width;
  // Writes the values of one step, unclipped and unscaled.
  void (*compute)(const Term& term, const TermInput& input, std::span<float> values);
};

std::span<const TermRow> TermRows();

}  // namespace understudy::policy
