#include "motion/quadruped/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;
namespace goal = authority::goal;

// All assumed.
constexpr double kUprightCosine = 0.85;  // from which the legs alone can lift or lower the robot
constexpr double kExtended = 0.6;        // of the standing height: higher is standing
constexpr double kCrouch = 0.25;         // feet under the hips, of the leg's length
constexpr double kBalanceTime = 1.0;     // s to a balanced stand
constexpr double kSitTime = 1.8;         // s
constexpr double kFallenCosine = 0.36;   // 1.2 rad: no legal pose tilts as far
constexpr double kSharpest = 0.25;       // rad/m, of the bends that wheels roll through
constexpr double kFallenRest = 1.0;      // s a fallen robot lies before it gets up by itself

bool IsFinite(const authority::MotionGoal& goal) {
  if (const auto* euler = std::get_if<goal::Euler>(&goal)) {
    return std::isfinite(euler->roll) && std::isfinite(euler->pitch) && std::isfinite(euler->yaw);
  }
  if (const auto* move = std::get_if<goal::Move>(&goal)) {
    return std::isfinite(move->vx) && std::isfinite(move->vy) && std::isfinite(move->yaw_rate);
  }
  const auto* height = std::get_if<goal::BodyHeight>(&goal);
  return height == nullptr || std::isfinite(height->height);
}

}  // namespace

QuadrupedMotion::QuadrupedMotion(const robot::RobotSpec& spec, const QuadrupedFigures& figures)
    : spec_(spec),
      figures_(spec.motion.quadruped),
      body_(figures),
      estimator_(body_),
      feet_(body_),
      stance_(body_),
      gesture_(&stance_, body_.leg_length(), figures_.stand_height),
      recovery_(body_),
      trot_(body_, estimator_, figures_),
      drive_(body_, estimator_, &stance_, figures_) {}

void QuadrupedMotion::Start(const authority::MotionInput& input) {
  reading_ = body_.Read(input);
  estimator_.Begin(reading_);
  Enter(kDamped);
  if (upright() && estimator_.height() > kExtended * figures_.stand_height) Enter(kBalance);
}

authority::MotionVerdict QuadrupedMotion::Ask(const authority::MotionGoal& goal) {
  const auto rows = QuadrupedTransitions();
  const bool known = std::ranges::count(rows, goal.index(), &QuadrupedTransition::wish) > 0;
  if (!known || !IsFinite(goal)) return authority::MotionVerdict::kUnknown;
  const auto holds = [this](QuadrupedWhen when) { return Holds(when); };
  const QuadrupedTransition* row = Find(rows, goal.index(), state_, holds);
  if (row == nullptr && kMovingStates.Has(state_)) {
    // What a balanced stand leads to is done once it has stopped.
    row = Find(rows, goal.index(), kBalance, holds);
    if (row != nullptr && row->verdict == authority::MotionVerdict::kTaken) {
      then_ = goal;
      move_.setZero();
      return row->verdict;
    }
  }
  if (row == nullptr) return authority::MotionVerdict::kNotNow;
  if (row->verdict == authority::MotionVerdict::kTaken) {
    if (row->to) Enter(*row->to);
    Keep(goal);
  }
  return row->verdict;
}

bool QuadrupedMotion::Holds(QuadrupedWhen when) const {
  switch (when) {
    case QuadrupedWhen::kUpright:
      return upright();
    case QuadrupedWhen::kLegged:
      return !wheeled();
    case QuadrupedWhen::kAlways:
      break;
  }
  return true;
}

void QuadrupedMotion::Enter(State state) {
  const State from = std::exchange(state_, state);
  if (!kStanceStates.Has(state) && state != kWalking) move_.setZero();
  switch (state) {
    case kDamped:
      fallen_for_ = 0;
      then_.reset();
      now_ = nullptr;
      break;
    case kLocked:
    case kLying:
      now_ = nullptr;
      break;
    case kFolding:
    case kFoldingOn: {
      if (from == kFolding || from == kFoldingOn) break;  // the move goes on, to another end
      PerLeg q;
      body_.Reach(Under(kCrouch * body_.leg_length()), &q);
      joints_.Begin(reading_, q);
      now_ = &joints_;
      break;
    }
    case kRising:
    case kRisingOn:
      if (from == kRising || from == kRisingOn) break;
      // Of a robot that stands the feet stay where they are.
      feet_.Begin(reading_,
                  kStanceStates.Has(from) ? stance_.FeetInBase(Default())
                                          : Under(figures_.stand_height - body_.radius()),
                  FeetMove::Load::kTaken);
      now_ = &feet_;
      break;
    case kLowering: {
      PerLeg feet = reading_.feet;
      for (Vector3d& foot : feet) foot.z() = -kCrouch * body_.leg_length();
      feet_.Begin(reading_, feet, FeetMove::Load::kGivenUp);
      now_ = &feet_;
      break;
    }
    case kUnfolding: {
      PerLeg q;
      for (std::size_t i = 0; i < 12; ++i) {
        q[i / 3][static_cast<Eigen::Index>(i % 3)] = spec_.lying.q[i];
      }
      joints_.Begin(reading_, q);
      now_ = &joints_;
      break;
    }
    case kBalance:
      Balance(from);
      break;
    case kHello:
    case kStretch:
    case kRisingSit:
      wanted_ = Default();
      gesture_.Begin(state == kHello     ? HelloKeyframes()
                     : state == kStretch ? StretchKeyframes()
                                         : std::span<const Keyframe>());
      now_ = &gesture_;
      break;
    case kEndingGesture:
      gesture_.End();
      break;
    case kSittingDown: {
      StancePose pose = Default();
      pose.place += Vector3d(figures_.sit[0], 0, figures_.sit[1]);
      pose.rpy.y() = figures_.sit[2];
      stance_.MoveTo(stance_.Feasible(pose), kSitTime);
      break;
    }
    case kSitting:
      break;
    case kPosing:
      Follow(InMetres(PosePosture(), body_.leg_length(), figures_.stand_height));
      break;
    case kRecovering:
      recovery_.Begin(reading_);
      now_ = &recovery_;
      break;
    case kWalking:
      wheel_angles_.fill(robot::kNoPosition);
      trot_.Begin(reading_, Under(figures_.stand_height - body_.radius()));
      trot_.Carry(wanted_.place.z(), wanted_.rpy);
      now_ = &trot_;
      break;
    case kDriving:
      drive_.Begin();
      now_ = &drive_;
      break;
  }
}

// Wheels roll ahead and through wide bends. What goes sideways or turns on the spot, where tyres
// would have to slip, is stepped with the wheels braked.
void QuadrupedMotion::Move(double dt) {
  move_for_ -= dt;
  if (move_for_ <= 0) move_.setZero();
  const Vector3d taken = trot_.Taken(move_);
  const bool steps = !wheeled() || std::abs(taken.y()) > figures_.walk.dead_band.y() ||
                     std::abs(taken.z()) > kSharpest * std::abs(taken.x());
  trot_.Ask(steps ? taken : Vector3d::Zero());
  drive_.Ask(steps ? Vector3d::Zero() : taken);
  if (state_ == kBalance && stance_.over() && !taken.isZero(0)) Enter(steps ? kWalking : kDriving);
}

void QuadrupedMotion::Balance(State from) {
  now_ = &stance_;
  if (kGestureStates.Has(from) || from == kDriving) return;
  if (kStanceStates.Has(from)) {
    Follow(Default());
    return;
  }
  stance_.Begin(reading_);
  if (from != kWalking) wanted_ = Default();
  stance_.MoveTo(stance_.Feasible(wanted_), kBalanceTime);
  wheel_angles_.fill(robot::kNoPosition);
}

void QuadrupedMotion::Keep(const authority::MotionGoal& goal) {
  if (const auto* recovery = std::get_if<goal::AutoRecovery>(&goal)) auto_recovery_ = recovery->on;
  if (const auto* move = std::get_if<goal::Move>(&goal);
      move != nullptr && (state_ == kBalance || kMovingStates.Has(state_))) {
    move_ = {move->vx, move->vy, move->yaw_rate};
    move_for_ = move->hold;
    then_.reset();
  }
  if (std::holds_alternative<goal::StopMove>(goal)) move_.setZero();
  StancePose wanted = wanted_;
  if (const auto* euler = std::get_if<goal::Euler>(&goal)) {
    const auto& most = figures_.euler_range;
    wanted.rpy = {std::clamp(euler->roll, -most[0], most[0]),
                  std::clamp(euler->pitch, -most[1], most[1]),
                  std::clamp(euler->yaw, -most[2], most[2])};
    Follow(wanted);
  } else if (const auto* body = std::get_if<goal::BodyHeight>(&goal)) {
    wanted.place.z() = figures_.stand_height +
                       std::clamp(body->height, figures_.height_range[0], figures_.height_range[1]);
    Follow(wanted);
  }
}

void QuadrupedMotion::Follow(const StancePose& pose) {
  wanted_ = pose;
  if (state_ == kWalking) {
    trot_.Carry(wanted_.place.z(), wanted_.rpy);
  } else {
    stance_.Follow(stance_.Feasible(wanted_));
  }
}

robot::MotionState QuadrupedMotion::state() const {
  const QuadrupedStateRow& row = RowOf(state_);
  robot::MotionState state{.id = row.id,
                           .mode = row.mode,
                           .progress = row.progress,
                           .body_height = estimator_.height(),
                           .estimates = true,
                           .v_WB_W = estimator_.v_WB_W(),
                           .p_WB = estimator_.p_WB(),
                           .gait = kMovingStates.Has(state_) ? 1 : 0,
                           .foot_raise = figures_.walk.foot_raise};
  for (std::size_t leg = 0; leg < state.feet.size(); ++leg) {
    state.feet[leg] = reading_.feet[leg];
    state.feet_speed[leg] = FootJacobian(reading_.places[leg]) * reading_.dq[leg];
  }
  return state;
}

void QuadrupedMotion::Step(const authority::MotionInput& input, double dt,
                           robot::RobotCommand* command) {
  reading_ = body_.Read(input);
  estimator_.Step(reading_, dt,
                  state_ == kWalking ? trot_.stands() : std::array<double, 4>{1, 1, 1, 1});
  WatchForFalls(dt);
  Move(dt);
  if (now_ != nullptr) now_->Step(reading_, dt, &legs_);
  command->joint_space = robot::JointSpace::kPitchRoll;
  if (state_ == kDamped) {
    Brake(figures_.damping_kd, command);
  } else if (state_ == kLying && wheeled()) {
    Brake(0, command);  // the vendor's Go2-W page: motors idle after StandDown
  } else {
    Legs(command);
    Wheels(input, command);
  }
  const State next = RowOf(state_).next;
  if (next != state_ && now_->over()) Enter(next);
  if (state_ == kBalance && then_) Ask(*std::exchange(then_, std::nullopt));
}

void QuadrupedMotion::WatchForFalls(double dt) {
  const bool held = state_ != kDamped && state_ != kRecovering;
  if (held && reading_.up.z() < kFallenCosine) {
    Enter(kDamped);
    fallen_for_ = dt;
  } else if (state_ == kDamped && fallen_for_ > 0) {
    fallen_for_ += dt;
    if (auto_recovery_ && fallen_for_ > kFallenRest) Enter(kRecovering);
  }
}

// All is said by q alone, with dq and tau 0: so a real Go2 does while it stands. The motor law
// makes the same torque of it.
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
    if (leg >= wheel_angles_.size()) continue;
    if (state_ == kDriving) {
      const double carried = stance_.held_rate().y() + legs_.dq[leg][1] + legs_.dq[leg][2];
      wheel.dq = drive_.rates()[leg] - carried;
      wheel_angles_[leg] = robot::kNoPosition;
      continue;
    }
    if (!kStanceStates.Has(state_) && state_ != kWalking) continue;
    // A wheel stays in place when it turns back by what pitch, thigh and calf turn it forwards.
    // That of a leg that steps keeps its place on the calf.
    const double carried =
        state_ == kWalking ? 0 : stance_.held().rpy.y() + legs_.q[leg][1] + legs_.q[leg][2];
    if (wheel_angles_[leg] == robot::kNoPosition) {
      wheel_angles_[leg] = input.motors[i].q + carried;
    }
    wheel.q = wheel_angles_[leg] - carried;
    wheel.kp = figures_.wheel_kp;
  }
}

void QuadrupedMotion::Brake(double kd, robot::RobotCommand* command) {
  for (robot::MotorCommand& motor : command->motors) {
    motor = {.enabled = true, .q = 0, .dq = 0, .tau = 0, .kp = 0, .kd = kd};
  }
}

PerLeg QuadrupedMotion::Under(double depth) const {
  PerLeg feet;
  for (std::size_t leg = 0; leg < feet.size(); ++leg) {
    const LegFigures& f = body_.leg(leg).figures();
    feet[leg] = f.hip + f.thigh + Vector3d(figures_.foot_x, f.calf.y() + f.foot.y(), 0);
    feet[leg].z() = -depth;
  }
  return feet;
}

StancePose QuadrupedMotion::Default() const {
  return {.place = {0, 0, figures_.stand_height}, .rpy = {0, 0, 0}};
}

bool QuadrupedMotion::upright() const { return reading_.up.z() > kUprightCosine; }

std::unique_ptr<authority::Motion> MakeQuadrupedMotion(const robot::RobotSpec& spec,
                                                       const physics::RobotBody& body) {
  return std::make_unique<QuadrupedMotion>(spec, ReadQuadruped(body));
}

}  // namespace understudy::motion
