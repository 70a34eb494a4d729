#include "motion/humanoid/motion.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/errors.h"
#include "base/overloaded.h"

namespace understudy::motion {
namespace {

constexpr double kSensePeriod = 0.004;  // s: the body needs 1/20 of that per step of feedback
constexpr double kMoveTime = 4;         // s: on hardware within 5 s (docs/sources.md#g1-states)

// Assumed, tried on every robot here.
constexpr double kLockStiffness = 1.75;  // of a locked joint, in m g h of the whole robot: a G1
                                         // stands with 400 N·m/rad at the ankle, which is that
constexpr double kSoftness = 0.15;       // of that, while balancing
constexpr double kLockDamping = 0.7;     // damping ratio of a locked joint in the air
constexpr double kBearingMass = 0.25;    // share of the robot's mass from which a joint bears
constexpr double kLoadTime = 0.03;       // s, over which foot loads are smoothed
constexpr double kFullLoad = 0.9;        // share of the weight from which a robot stands by itself
constexpr double kBlendTime = 0.5;       // s, from locked to balancing
constexpr double kCentreTime = 1;        // s, in which the centre of mass goes to the middle
constexpr double kSettleTime = 1;        // s, into the standing pose of a robot found standing
constexpr double kFoundTilt = 0.3;       // rad, at most, of a robot that stands
constexpr double kFoundPose = 0.25;      // rad, at most, off its standing pose
constexpr double kLowStand = 0.35;       // of the way down to the squat: the lowest stand height
constexpr double kHeightTime = 1.5;      // s, for a change of stand height
constexpr double kSquatTime = 3;         // s

// A robot that leans further has fallen: the vendor's client trips there too (unitree_sdk2
// terminations.hpp).
constexpr double kFallenTilt = 1;  // rad

}  // namespace

HumanoidMotion::HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body)
    : spec_(spec),
      ids_(spec.motion.humanoid),
      body_(body.model(), body.spec()),
      arms_(spec, body_),
      bears_(spec.motors.size()),
      kp_(spec.motors.size()),
      kd_(spec.motors.size()),
      q_(spec.motors.size()),
      dq_(spec.motors.size()),
      posture_(spec.motors.size()),
      tau_(spec.motors.size()) {
  if (body_.soles().size() != 2) throw ModelError(spec.name + ": expected two feet (feet)");
  standing_ = StandOf(spec.standing.q);
  if (!ids_.squat_q.empty()) {
    std::vector<double> middle(ids_.squat_q);
    for (std::size_t i = 0; i < middle.size(); ++i) middle[i] += spec.standing.q[i];
    for (double& q : middle) q /= 2;
    half_down_ = StandOf(middle);
    squatting_ = StandOf(ids_.squat_q);
  }
  FindGains();
}

HumanoidMotion::Stand HumanoidMotion::StandOf(std::span<const double> q) {
  const std::vector<double> still(q.size());
  // The unit's reading for an upright base, then for flat soles: both from what it reads when the
  // soles are as they are.
  robot::ImuReading imu;
  body_.Update(q, still, imu);
  const Eigen::Matrix3d R_IB = body_.attitude();  // the unit was taken to be upright
  const auto tilt_of_soles = [&] {
    const Eigen::Vector3d up = body_.soles()[0].up + body_.soles()[1].up;
    return std::atan2(up.x(), up.z());
  };
  imu.R_WI = Eigen::Quaterniond(Eigen::Matrix3d(R_IB.transpose()));
  body_.Update(q, still, imu);
  const double pitch = -tilt_of_soles();
  const Eigen::Matrix3d R_WB =
      Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()).toRotationMatrix();
  imu.R_WI = Eigen::Quaterniond(Eigen::Matrix3d(R_WB * R_IB.transpose()));
  body_.Update(q, still, imu);
  return {.com_height = body_.com().z(), .base_height = body_.base().z(), .pitch = pitch};
}

void HumanoidMotion::FindGains() {
  const double stiff = kLockStiffness * body_.mass() * body_.gravity() * standing_.com_height;
  const double period = body_.motor_period();
  for (std::size_t i = 0; i < spec_.motors.size(); ++i) {
    bears_[i] = body_.IsOfLeg(i) || body_.CarriedMass(i) > kBearingMass * body_.mass();
    kp_[i] = spec_.motors[i].hold_kp;
    kd_[i] = spec_.motors[i].hold_kd;
    if (!bears_[i]) continue;
    // A torque that is held for one period makes a spring of more than that swing by itself.
    const double inertia = body_.FeltInertia(i);
    kp_[i] = std::min(stiff, 0.1 * inertia / (period * period));
    kd_[i] = 2 * kLockDamping * std::sqrt(kp_[i] * inertia);
  }
}

void HumanoidMotion::Start(const authority::MotionInput& input) {
  arms_.Reset();
  id_ = kZeroTorqueId;
  fresh_ = true;
  Feel(input, 0);
  body_.Update(q_, dq_, input.imu);
  double off = 0;
  for (std::size_t i = 0; i < q_.size(); ++i) {
    if (bears_[i]) off = std::max(off, std::abs(q_[i] - spec_.standing.q[i]));
  }
  const bool upright = body_.attitude()(2, 2) > std::cos(kFoundTilt);
  if (!upright || off > kFoundPose ||
      StanceOf(ids_, ids_.lock_stand) != HumanoidStance::kLockStand) {
    return;
  }
  id_ = ids_.lock_stand;
  posture_.Begin(q_, spec_.standing.q, kSettleTime);
}

authority::MotionVerdict HumanoidMotion::Ask(const authority::MotionGoal& goal) {
  using authority::MotionVerdict;
  namespace goal_of = authority::goal;
  const auto when_balanced = [this](MotionVerdict verdict) {
    return balanced() ? verdict : MotionVerdict::kNotNow;
  };
  return std::visit(
      Overloaded{
          [&](goal_of::ZeroTorque) { return SetFsm(kZeroTorqueId); },
          [&](goal_of::Damp) { return SetFsm(kDampingId); },
          [&](goal_of::StandUp) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::RiseSit) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::StandDown) { return SetFsm(ids_.squat); },
          [&](goal_of::Sit) { return SetFsm(ids_.sit); },
          [&](goal_of::BalanceStand) {
            return SetFsm(ids_.balance.empty() ? -1 : static_cast<int>(ids_.balance.front()));
          },
          [&](const goal_of::SetFsm& fsm) { return SetFsm(fsm.id); },
          [&](goal_of::StopMove) { return when_balanced(MotionVerdict::kTaken); },  // it stands
          [&](const goal_of::Move&) { return when_balanced(MotionVerdict::kUnable); },
          [&](const goal_of::SetBalanceMode& balance) {
            return when_balanced(balance.mode == 0 ? MotionVerdict::kTaken
                                                   : MotionVerdict::kUnable);
          },
          [&](const goal_of::SetStandHeight& stand) { return SetStandHeight(stand.height); },
          [&](const goal_of::ArmAction& action) { return BeginArmAction(action.id); },
          [&](goal_of::StopArmAction) {
            arms_.Release();
            return MotionVerdict::kTaken;
          },
          [&](goal_of::RecoveryStand) { return MotionVerdict::kUnable; },
          [&](const auto&) { return MotionVerdict::kUnknown; },  // a quadruped's
      },
      goal);
}

authority::MotionVerdict HumanoidMotion::SetFsm(int id) {
  const authority::MotionVerdict verdict = MayGo(ids_, id_, id, moving());
  if (verdict != authority::MotionVerdict::kTaken) return verdict;
  if (id == kZeroTorqueId && id_ != kDampingId) return verdict;  // nothing, where it bears load
  if (id == id_ && id != ids_.balanced_squat) return verdict;
  if (id == kZeroTorqueId || id == kDampingId) {
    arms_.Reset();
    id_ = id;
  } else if (id == ids_.lock_stand) {
    Lock(spec_.standing.q);
    id_ = id;
  } else if (id == ids_.squat || id == ids_.sit) {
    Lock(id == ids_.squat ? ids_.squat_q : ids_.sit_q);
    id_ = id;
  } else {
    Balance(id);
  }
  return verdict;
}

void HumanoidMotion::Lock(std::span<const double> q) {
  arms_.Reset();
  posture_.Begin(q_, q, kMoveTime);
}

void HumanoidMotion::Balance(int id) {
  constexpr std::array kUp = {0.0}, kDown = {1.0};
  if (id == ids_.balanced_squat) {
    const std::array from = {depth_.q(0)};
    const bool down = id_ == id;  // then up
    arms_.Release();
    depth_.Begin(from, down ? kUp : kDown, kSquatTime);
  } else if (!balanced()) {
    depth_.Begin(kUp, kUp, 0);
    const Eigen::Vector2d offset = ComOffset(body_);
    constexpr std::array kMiddle = {0.0, 0.0};
    com_offset_.Begin(std::array{offset.x(), offset.y()}, kMiddle, kCentreTime);
    balanced_for_ = 0;
  }
  if (id != ids_.balanced_squat) stood_in_ = id;
  id_ = id;
}

authority::MotionVerdict HumanoidMotion::SetStandHeight(double height) {
  if (!std::isfinite(height)) return authority::MotionVerdict::kUnknown;
  if (!balanced()) return authority::MotionVerdict::kNotNow;
  if (ids_.squat_q.empty()) return authority::MotionVerdict::kUnable;
  if (moving() || id_ == ids_.balanced_squat) return authority::MotionVerdict::kNotNow;
  const std::array from = {depth_.q(0)};
  const std::array to = {kLowStand * (1 - std::clamp(height, 0.0, 1.0))};
  depth_.Begin(from, to, kHeightTime);
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict HumanoidMotion::BeginArmAction(int id) {
  if (!ids_.arm_actions) return authority::MotionVerdict::kUnknown;
  const bool allowed = balanced() && id_ != ids_.balanced_squat;
  // A number that does not exist is said before a state that does not allow it.
  if (!allowed && id != kReleaseArms && FindArmAction(id) == nullptr && !IsUnplayedArmAction(id)) {
    return authority::MotionVerdict::kUnknown;
  }
  return allowed ? arms_.Begin(id) : authority::MotionVerdict::kNotNow;
}

bool HumanoidMotion::locked() const { return kLockedStances.Has(StanceOf(ids_, id_)); }

bool HumanoidMotion::balanced() const { return kBalancedStances.Has(StanceOf(ids_, id_)); }

bool HumanoidMotion::moving() const {
  if (locked()) return !posture_.over();
  return balanced() && !depth_.over();
}

robot::MotionState HumanoidMotion::state() const {
  return {.id = id_,
          .mode = moving() ? 1 : 0,
          .progress = moving() || (arms_.id() != 0 && !arms_.holding()) ? 1 : 0,
          .arm_action = arms_.id(),
          .arm_holding = arms_.holding(),
          .body_height = body_.base().z()};
}

void HumanoidMotion::Step(const authority::MotionInput& input, double dt,
                          robot::RobotCommand* command) {
  Feel(input, dt);
  since_sensed_ += dt;
  if (fresh_ || since_sensed_ > kSensePeriod - dt / 2) {
    Sense(input, fresh_ ? kSensePeriod : since_sensed_);
    since_sensed_ = 0;
    fresh_ = false;
  }
  command->joint_space = robot::JointSpace::kPitchRoll;
  if (locked()) {
    posture_.Advance(dt);
    HoldPosture(command);
  } else if (balanced()) {
    balanced_for_ += dt;
    depth_.Advance(dt);
    com_offset_.Advance(dt);
    arms_.Advance(dt);
    HoldPosture(command);
    if (id_ == ids_.balanced_squat && depth_.over() && depth_.q(0) == 0) id_ = stood_in_;
  } else {
    Brake(command);
  }
}

void HumanoidMotion::Feel(const authority::MotionInput& input, double dt) {
  for (std::size_t i = 0; i < q_.size(); ++i) {
    q_[i] = input.motors[i].q;
    dq_[i] = input.motors[i].dq;
  }
  const double force = std::accumulate(input.foot_force.begin(), input.foot_force.end(), 0.0);
  const double share = force / (kFullLoad * body_.mass() * body_.gravity());
  const double load = std::clamp(share, 0.0, 1.0);
  load_ = dt == 0 ? load : load_ + (load - load_) * dt / (dt + kLoadTime);
}

void HumanoidMotion::Sense(const authority::MotionInput& input, double dt) {
  body_.Update(q_, dq_, input.imu);
  const bool balances = balanced();
  if (balances && body_.attitude()(2, 2) < std::cos(kFallenTilt)) {
    arms_.Reset();
    id_ = kDampingId;
  }
  if (balances) {
    balance_.Step(body_, BalanceGoal(), load_, dt);
  } else {
    balance_.Rest(body_, load_);
  }
  for (std::size_t i = 0; i < tau_.size(); ++i) tau_[i] = body_.GravityTorque(i);
  for (std::size_t foot = 0; foot < 2; ++foot) {
    const GroundReaction& ground = balance_.reactions()[foot];
    body_.AddGroundReaction(foot, ground.force, ground.moment, tau_);
  }
}

StandGoal HumanoidMotion::BalanceGoal() const {
  // The parabola through the three postures that are known.
  const double d = depth_.q(0);
  const double up = (1 - d) * (1 - 2 * d), half = 4 * d * (1 - d), down = d * (2 * d - 1);
  return {.com_offset = {com_offset_.q(0), com_offset_.q(1)},
          .base_height = up * standing_.base_height + half * half_down_.base_height +
                         down * squatting_.base_height,
          .pitch = up * standing_.pitch + half * half_down_.pitch + down * squatting_.pitch};
}

double HumanoidMotion::Crouched(std::size_t motor) const {
  const double q = spec_.standing.q[motor];
  return depth_.q(0) == 0 ? q : q + depth_.q(0) * (ids_.squat_q[motor] - q);
}

void HumanoidMotion::Brake(robot::RobotCommand* command) const {
  const bool limp = id_ == kZeroTorqueId;
  for (std::size_t i = 0; i < kd_.size(); ++i) {
    command->motors[i] = {.enabled = true, .kd = limp ? 0 : kd_[i]};
  }
}

void HumanoidMotion::HoldPosture(robot::RobotCommand* command) const {
  const bool balances = balanced();
  const double soft = balances ? load_ * SmoothStep(balanced_for_ / kBlendTime) : 0;
  for (std::size_t i = 0; i < kp_.size(); ++i) {
    robot::MotorCommand& motor = command->motors[i];
    motor = {.enabled = true,
             .q = balances ? Crouched(i) : posture_.q(i),
             .dq = balances ? 0 : posture_.dq(i),
             .tau = tau_[i],
             .kp = kp_[i],
             .kd = kd_[i]};
    if (body_.IsOfLeg(i)) motor.kp *= 1 + soft * (kSoftness - 1);
  }
  if (!balances) return;
  for (std::size_t i = 0; i < arms_.motors().size(); ++i) {
    robot::MotorCommand& motor = command->motors[static_cast<std::size_t>(arms_.motors()[i])];
    motor.q = arms_.q(i);
    motor.dq = arms_.dq(i);
  }
}

std::unique_ptr<authority::Motion> MakeHumanoidMotion(const robot::RobotSpec& spec,
                                                      const physics::RobotBody& body) {
  return std::make_unique<HumanoidMotion>(spec, body);
}

}  // namespace understudy::motion
