#include "policy/terms.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace understudy::policy {
namespace {

using Values = std::span<float>;

void Copy(const Eigen::Vector3f& from, Values values) {
  std::copy(from.data(), from.data() + from.size(), values.begin());
}

void BaseAngVel(const Term&, const TermInput& input, Values values) {
  Copy(input.sensed.w_WI_I, values);
}

void ProjectedGravity(const Term&, const TermInput& input, Values values) {
  Copy(input.sensed.R_WI.conjugate() * Eigen::Vector3f(0, 0, -1), values);
}

void VelocityCommands(const Term&, const TermInput& input, Values values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto& [least, most] = input.definition.velocity[i];
    values[i] = std::clamp(input.sensed.velocity[static_cast<Eigen::Index>(i)], least, most);
  }
}

void JointPos(const Term& term, const TermInput& input, Values values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = input.sensed.q[static_cast<Eigen::Index>(term.joints[i])];
  }
}

void JointPosRel(const Term& term, const TermInput& input, Values values) {
  JointPos(term, input, values);
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] -= input.definition.default_q[term.joints[i]];
  }
}

void JointVelRel(const Term& term, const TermInput& input, Values values) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    values[i] = input.sensed.dq[static_cast<Eigen::Index>(term.joints[i])];
  }
}

void LastAction(const Term&, const TermInput& input, Values values) {
  std::copy(input.last_action.begin(), input.last_action.end(), values.begin());
}

// The phase in float32 and its angle in float64, as the vendor's program has them.
void GaitPhase(const Term& term, const TermInput& input, Values values) {
  const float advance = input.definition.step_dt * (1.0F / term.period);
  *input.phase = std::fmod(*input.phase + advance, 1.0F);
  const double angle = *input.phase * 2 * M_PI;
  values[0] = static_cast<float>(std::sin(angle));
  values[1] = static_cast<float>(std::cos(angle));
}

using enum TermRow::Width;
constexpr std::array kRows{
    TermRow{"base_ang_vel", "gyroscope of LowState, rad/s", kThree, BaseAngVel},
    TermRow{"projected_gravity", "direction of gravity in the IMU's axes", kThree,
            ProjectedGravity},
    TermRow{"velocity_commands",
            "commanded velocity forward, left m/s, turn rad/s, within commands.base_velocity",
            kThree, VelocityCommands},
    TermRow{"joint_pos", "joint angles, rad", kJoints, JointPos},
    TermRow{"joint_pos_rel", "joint angles less default_joint_pos, rad", kJoints, JointPosRel},
    TermRow{"joint_vel_rel", "joint rates, rad/s", kJoints, JointVelRel},
    TermRow{"last_action", "the last output of the network; 0 at the start", kActions, LastAction},
    TermRow{"gait_phase", "sine and cosine of a phase that turns in params.period s", kTwo,
            GaitPhase},
};

}  // namespace

std::span<const TermRow> TermRows() { return kRows; }

}  // namespace understudy::policy
