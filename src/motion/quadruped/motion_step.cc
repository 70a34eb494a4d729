// What the states of QuadrupedMotion do in a step, and how they follow one another.
#include <algorithm>
#include <array>
#include <cmath>

#include "motion/quadruped/motion.h"

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// All assumed.
constexpr double kFallenCosine = 0.36;  // 1.2 rad: no legal pose tilts as far
constexpr double kFallenRest = 1.0;     // s a fallen robot lies before it gets up by itself
constexpr double kCrouch = 0.25;        // feet under the hips, of the leg's length
constexpr double kJointSpeed = 2.5;     // rad/s, mean of the fastest joint between two postures
constexpr double kShortestMove = 0.5;   // s
constexpr double kRiseTime = 1.2;       // s
constexpr double kLoading = 0.4;        // of that time: until the feet carry all

std::array<double, 12> Flat(const PerLeg& q) {
  std::array<double, 12> flat{};
  for (std::size_t i = 0; i < 12; ++i) flat[i] = q[i / 3][static_cast<Eigen::Index>(i % 3)];
  return flat;
}

}  // namespace

PerLeg QuadrupedMotion::Under(double depth) const {
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    const LegFigures& f = body_.leg(leg).figures();
    feet[leg] = f.hip + f.thigh + Vector3d(figures_.foot_x, f.calf.y() + f.foot.y(), 0);
    feet[leg].z() = -depth;
  }
  return feet;
}

PerLeg QuadrupedMotion::Stand() const { return Under(figures_.stand_height - body_.radius()); }

void QuadrupedMotion::MoveJoints(State state, const PerLeg& goal) {
  double most = 0;
  for (std::size_t leg = 0; leg < goal.size(); ++leg) {
    most = std::max(most, (goal[leg] - reading_.q[leg]).cwiseAbs().maxCoeff());
  }
  joints_.Begin(Flat(reading_.q), Flat(goal), std::max(most / kJointSpeed, kShortestMove));
  state_ = state;
}

void QuadrupedMotion::MoveFeet(State state, const PerLeg& goal) {
  feet_from_ = reading_.feet;
  feet_to_ = goal;
  elapsed_ = 0;
  state_ = state;
}

void QuadrupedMotion::Fold() {
  PerLeg q;
  body_.Reach(Under(kCrouch * body_.leg_length()), &q);
  MoveJoints(State::kFolding, q);
}

void QuadrupedMotion::Rise(const PerLeg& feet) { MoveFeet(State::kRising, feet); }

void QuadrupedMotion::Lower() {
  PerLeg feet = reading_.feet;
  for (Vector3d& foot : feet) foot.z() = -kCrouch * body_.leg_length();
  MoveFeet(State::kLowering, feet);
}

void QuadrupedMotion::Unfold() {
  PerLeg q;
  for (std::size_t i = 0; i < 12; ++i) {
    q[i / 3][static_cast<Eigen::Index>(i % 3)] = spec_.lying.q[i];
  }
  MoveJoints(State::kUnfolding, q);
}

void QuadrupedMotion::StepJoints(double dt, StanceCommand* legs) {
  joints_.Advance(dt);
  for (std::size_t i = 0; i < 12; ++i) {
    const auto at = static_cast<Eigen::Index>(i % 3);
    legs->q[i / 3][at] = joints_.q(i);
    legs->dq[i / 3][at] = joints_.dq(i);
  }
  for (Vector3d& tau : legs->tau) tau.setZero();
}

void QuadrupedMotion::StepFeet(double dt, StanceCommand* legs) {
  elapsed_ += dt;
  const double part = elapsed_ / kRiseTime;
  const double s = SmoothStep(part);
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    feet[leg] = feet_from_[leg] + s * (feet_to_[leg] - feet_from_[leg]);
  }
  body_.Reach(feet, &legs->q);
  for (Vector3d& dq : legs->dq) dq.setZero();
  const double share =
      state_ == State::kRising ? SmoothStep(part / kLoading) : SmoothStep((1 - part) / kLoading);
  legs->tau = body_.SupportTorque(reading_, {1, 1, 1, 1}, share);
}

void QuadrupedMotion::Step(const authority::MotionInput& input, double dt,
                           robot::RobotCommand* command) {
  reading_ = body_.Read(input);
  estimator_.Step(reading_, dt);
  if (stands() && reading_.up.z() < kFallenCosine) {
    state_ = State::kDamped;
    fallen_for_ = dt;
  } else if (state_ == State::kDamped && fallen_for_ > 0) {
    fallen_for_ += dt;
    if (auto_recovery_ && fallen_for_ > kFallenRest) Recover();
  }
  command->joint_space = robot::JointSpace::kPitchRoll;
  switch (state_) {
    case State::kDamped:
      break;
    case State::kFolding:
    case State::kUnfolding:
      StepJoints(dt, &legs_);
      break;
    case State::kRising:
    case State::kLowering:
      StepFeet(dt, &legs_);
      break;
    case State::kLocked:
    case State::kLying:
      break;  // as they were
    case State::kBalance:
    case State::kGesture:
    case State::kSittingDown:
    case State::kSitting:
    case State::kPosing:
      legs_ = stance_.Step(reading_, dt);
      break;
    case State::kRecovering:
      recovery_.Step(reading_, dt, &legs_.q, &legs_.dq);
      for (Vector3d& tau : legs_.tau) tau.setZero();
      break;
  }
  if (state_ == State::kDamped) {
    Brake(figures_.damping_kd, command);
  } else if (state_ == State::kLying && wheeled()) {
    Brake(0, command);  // the vendor's Go2-W page: motors idle after StandDown
  } else {
    Legs(command);
    Wheels(input, command);
  }
  Advance();
}

void QuadrupedMotion::Advance() {
  switch (state_) {
    case State::kFolding:
      if (joints_.over()) Rise(Stand());
      break;
    case State::kRising:
      if (elapsed_ < kRiseTime) break;
      state_ = State::kLocked;
      if (balance_next_) Balance();
      break;
    case State::kLowering:
      if (elapsed_ >= kRiseTime) Unfold();
      break;
    case State::kUnfolding:
      if (joints_.over()) state_ = State::kLying;
      break;
    case State::kGesture:
      if (!stance_.over()) break;
      if (frame_ < frames_.size()) {
        Play(frame_ + 1);
      } else {
        state_ = State::kBalance;
      }
      break;
    case State::kSittingDown:
      if (stance_.over()) state_ = State::kSitting;
      break;
    case State::kRecovering:
      if (!recovery_.over()) break;
      balance_next_ = true;
      Fold();
      break;
    default:
      break;
  }
}

bool QuadrupedMotion::stands() const {
  return state_ != State::kDamped && state_ != State::kRecovering;
}

bool QuadrupedMotion::balances() const {
  return state_ == State::kBalance || state_ == State::kGesture || state_ == State::kSittingDown ||
         state_ == State::kSitting || state_ == State::kPosing;
}

// All is said by q alone, with dq and tau 0: so a real Go2 does while it stands
// (docs/sources.md#go2-captures). The motor law makes the same torque of it.
void QuadrupedMotion::Legs(robot::RobotCommand* command) const {
  const double kp = figures_.kp, kd = figures_.kd;
  for (std::size_t i = 0; i < 12; ++i) {
    const std::size_t leg = i / 3;
    const auto at = static_cast<Eigen::Index>(i % 3);
    const double q = legs_.q[leg][at] + (legs_.tau[leg][at] + kd * legs_.dq[leg][at]) / kp;
    command->motors[i] = {.enabled = true, .q = q, .dq = 0, .tau = 0, .kp = kp, .kd = kd};
  }
}

void QuadrupedMotion::Wheels(const authority::MotionInput& input, robot::RobotCommand* command) {
  for (std::size_t i = 12; i < command->motors.size(); ++i) {
    robot::MotorCommand& wheel = command->motors[i];
    wheel = {.enabled = true, .q = 0, .dq = 0, .tau = 0, .kp = 0, .kd = figures_.wheel_kd};
    const std::size_t leg = i - 12;
    if (!balances() || leg >= wheel_angles_.size()) continue;
    // A wheel stays in place when it turns back by what pitch, thigh and calf turn it forwards.
    const double carried = stance_.held().rpy.y() + legs_.q[leg][1] + legs_.q[leg][2];
    if (wheel_angles_[leg] == robot::kNoPosition) wheel_angles_[leg] = input.motors[i].q + carried;
    wheel.q = wheel_angles_[leg] - carried;
    wheel.kp = figures_.wheel_kp;
  }
}

void QuadrupedMotion::Brake(double kd, robot::RobotCommand* command) {
  for (robot::MotorCommand& motor : command->motors) {
    motor = {.enabled = true, .q = 0, .dq = 0, .tau = 0, .kp = 0, .kd = kd};
  }
}

}  // namespace understudy::motion
