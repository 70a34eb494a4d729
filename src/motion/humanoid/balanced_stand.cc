#include "motion/humanoid/balanced_stand.h"

#include <algorithm>
#include <array>
#include <vector>

namespace understudy::motion {
namespace {

// Assumed, tried on every robot here.
constexpr double kSoftness = 0.15;   // of the stiffness of a locked joint
constexpr double kBlendTime = 0.5;   // s, from locked to balancing
constexpr double kCentreTime = 1;    // s, in which the centre of mass goes to the middle
constexpr double kLowStand = 0.35;   // of the way down to the squat: the lowest stand height
constexpr double kHeightTime = 1.5;  // s, for a change of stand height

// "6 to 7 s" of a G1 (docs/dev/sources.md#g1-states).
constexpr double kSquatTime = 6.5;  // s

}  // namespace

BalancedStand::BalancedStand(const robot::RobotSpec& spec, const JointGains& gains, BodyModel* body,
                             Bearing* bearing)
    : spec_(spec), gains_(gains), bearing_(bearing), arms_(spec, *body) {
  for (std::size_t i = 0; i < spec.motors.size(); ++i) soft_.push_back(body->IsOfLeg(i));
  standing_ = StandOf(spec.standing.q, body);
  std::vector<double> middle(spec.motion.humanoid.squat_q);
  if (middle.empty()) return;
  squatting_ = StandOf(middle, body);
  for (std::size_t i = 0; i < middle.size(); ++i) middle[i] = (middle[i] + spec.standing.q[i]) / 2;
  half_down_ = StandOf(middle, body);
}

void BalancedStand::Begin(const HumanoidReading& sensed, bool walked) {
  constexpr std::array kUp = {0.0};
  constexpr std::array kMiddle = {0.0, 0.0};
  depth_.Begin(kUp, kUp, 0);
  const Eigen::Vector2d offset = ComOffset(sensed.body);
  com_offset_.Begin(std::array{offset.x(), offset.y()}, kMiddle, kCentreTime);
  squats_ = false;
  elapsed_ = walked ? kBlendTime : 0;
}

void BalancedStand::Squat(bool down) {
  arms_.Release();
  squats_ = down;
  GoTo(down ? 1 : 0, kSquatTime);
}

void BalancedStand::StandAt(double height) {
  GoTo(kLowStand * (1 - std::clamp(height, 0.0, 1.0)), kHeightTime);
}

void BalancedStand::GoTo(double depth, double duration) {
  depth_.Begin(std::array{depth_.q(0)}, std::array{depth}, duration);
}

void BalancedStand::Step(const HumanoidReading& sensed, double dt, robot::RobotCommand* command) {
  bearing_->Balance(sensed, Goal());
  elapsed_ += dt;
  depth_.Advance(dt);
  com_offset_.Advance(dt);
  arms_.Advance(dt);
  const double soft = sensed.load * SmoothStep(elapsed_ / kBlendTime);
  for (std::size_t i = 0; i < gains_.kp.size(); ++i) {
    command->motors[i] = {.enabled = true,
                          .q = Crouched(i),
                          .dq = 0,
                          .tau = bearing_->tau(i),
                          .kp = gains_.kp[i] * (soft_[i] ? 1 + soft * (kSoftness - 1) : 1),
                          .kd = gains_.kd[i]};
  }
  for (std::size_t i = 0; i < arms_.motors().size(); ++i) {
    robot::MotorCommand& motor = command->motors[static_cast<std::size_t>(arms_.motors()[i])];
    motor.q = arms_.q(i);
    motor.dq = arms_.dq(i);
  }
}

StandGoal BalancedStand::Goal() const {
  // The parabola through the three known postures.
  const double d = depth_.q(0);
  const double up = (1 - d) * (1 - 2 * d), half = 4 * d * (1 - d), down = d * (2 * d - 1);
  return {.com_offset = {com_offset_.q(0), com_offset_.q(1)},
          .base_height = up * standing_.base_height + half * half_down_.base_height +
                         down * squatting_.base_height,
          .pitch = up * standing_.pitch + half * half_down_.pitch + down * squatting_.pitch};
}

double BalancedStand::Crouched(std::size_t motor) const {
  const double q = spec_.standing.q[motor];
  return depth_.q(0) == 0 ? q : q + depth_.q(0) * (spec_.motion.humanoid.squat_q[motor] - q);
}

}  // namespace understudy::motion
