#include "motion/quadruped/motion.h"

#include <algorithm>
#include <cmath>

namespace understudy {
namespace {

using Eigen::Vector3d;

// All assumed.
constexpr double kUprightCosine = 0.85;  // from which the legs alone can lift or lower the robot
constexpr double kExtended = 0.6;        // of the standing height: higher is standing
constexpr double kReturnTime = 1.0;      // s back to a balanced stand
constexpr double kSitTime = 1.8;         // s

}  // namespace

QuadrupedMotion::QuadrupedMotion(const RobotSpec& spec, const QuadrupedFigures& figures)
    : spec_(spec),
      figures_(spec.motion.quadruped),
      body_(figures),
      stance_(body_),
      recovery_(body_),
      joints_(12) {}

void QuadrupedMotion::Start(const MotionInput& input) {
  reading_ = body_.Read(input);
  state_ = State::kDamped;
  balance_next_ = false;
  fallen_for_ = 0;
  if (upright() && body_.Height(reading_) > kExtended * figures_.stand_height) Balance();
}

MotionVerdict QuadrupedMotion::Ask(const MotionGoal& goal) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(goal.value.begin(), goal.value.end(), finite)) return MotionVerdict::kUnknown;
  switch (goal.action) {
    case MotionAction::kDamp:
      state_ = State::kDamped;
      fallen_for_ = 0;
      return MotionVerdict::kTaken;
    case MotionAction::kAutoRecovery:
      auto_recovery_ = goal.value[0] != 0;
      return MotionVerdict::kTaken;
    case MotionAction::kStandUp:
      return StandUp();
    case MotionAction::kStandDown:
      return StandDown();
    case MotionAction::kBalanceStand:
      return BalanceStand();
    case MotionAction::kRecoveryStand:
      return Recover();
    case MotionAction::kSit:
      return Sit();
    case MotionAction::kRiseSit:
      return RiseSit();
    case MotionAction::kHello:
      return Gesture(HelloKeyframes());
    case MotionAction::kStretch:
      return Gesture(StretchKeyframes());
    case MotionAction::kPose:
      return Pose(goal.value[0] != 0);
    case MotionAction::kEuler:
      return Euler({goal.value[0], goal.value[1], goal.value[2]});
    case MotionAction::kBodyHeight:
      return BodyHeight(goal.value[0]);
    case MotionAction::kStopMove:
      return StopMove();
    case MotionAction::kMove:
      return Move();
    default:
      return MotionVerdict::kUnknown;
  }
}

MotionVerdict QuadrupedMotion::StandUp() {
  switch (state_) {
    case State::kDamped:
    case State::kUnfolding:
    case State::kLying:
      if (!upright()) return MotionVerdict::kNotNow;
      balance_next_ = false;
      Fold();
      return MotionVerdict::kTaken;
    case State::kLowering:
      balance_next_ = false;
      Rise(Stand());
      return MotionVerdict::kTaken;
    case State::kFolding:
    case State::kRising:
    case State::kLocked:
      balance_next_ = false;
      return MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      balance_next_ = false;
      Rise(stance_.FeetInBase(Default()));  // the feet stay where they are
      return MotionVerdict::kTaken;
    default:
      return MotionVerdict::kNotNow;
  }
}

MotionVerdict QuadrupedMotion::StandDown() {
  switch (state_) {
    case State::kDamped:
      if (!upright()) return MotionVerdict::kNotNow;
      Unfold();
      return MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      if (wheeled()) return MotionVerdict::kNotNow;
      Lower();
      return MotionVerdict::kTaken;
    case State::kLocked:
      Lower();
      return MotionVerdict::kTaken;
    case State::kLowering:
    case State::kUnfolding:
    case State::kLying:
      return MotionVerdict::kTaken;
    default:
      return MotionVerdict::kNotNow;
  }
}

MotionVerdict QuadrupedMotion::BalanceStand() {
  switch (state_) {
    case State::kRising:
      balance_next_ = true;
      return MotionVerdict::kTaken;
    case State::kLocked:
      Balance();
      return MotionVerdict::kTaken;
    case State::kPosing:
      return Pose(false);
    case State::kBalance:
      return MotionVerdict::kTaken;
    default:
      return MotionVerdict::kNotNow;
  }
}

MotionVerdict QuadrupedMotion::Recover() {
  switch (state_) {
    case State::kRecovering:
      return MotionVerdict::kTaken;
    case State::kDamped:
    case State::kFolding:
    case State::kLowering:
    case State::kUnfolding:
    case State::kLying:
      state_ = State::kRecovering;
      recovery_.Begin(reading_);
      return MotionVerdict::kTaken;
    case State::kSittingDown:
    case State::kSitting:
      return wheeled() ? MotionVerdict::kNotNow : RiseSit();
    default:
      return wheeled() ? MotionVerdict::kNotNow : BalanceStand();
  }
}

MotionVerdict QuadrupedMotion::Sit() {
  if (state_ == State::kSitting) return MotionVerdict::kTaken;
  if (state_ != State::kBalance) return MotionVerdict::kNotNow;
  StancePose pose = Default();
  pose.place += Vector3d(figures_.sit[0], 0, figures_.sit[1]);
  pose.rpy.y() = figures_.sit[2];
  stance_.MoveTo(stance_.Feasible(pose), kSitTime);
  state_ = State::kSittingDown;
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::RiseSit() {
  if (state_ != State::kSitting) return MotionVerdict::kNotNow;
  frames_ = {};
  Play(0);
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::Gesture(std::span<const Keyframe> frames) {
  if (state_ != State::kBalance) return MotionVerdict::kNotNow;
  frames_ = frames;
  Play(0);
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::Pose(bool on) {
  if (state_ != State::kBalance && state_ != State::kPosing) return MotionVerdict::kNotNow;
  wanted_ = on ? InMetres(PosePosture()) : Default();
  stance_.Follow(stance_.Feasible(wanted_));
  state_ = on ? State::kPosing : State::kBalance;
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::Euler(const Vector3d& rpy) {
  if (state_ != State::kBalance && state_ != State::kPosing) return MotionVerdict::kNotNow;
  for (int i = 0; i < 3; ++i) {
    const double most = figures_.euler_range[static_cast<std::size_t>(i)];
    wanted_.rpy[i] = std::clamp(rpy[i], -most, most);
  }
  stance_.Follow(stance_.Feasible(wanted_));
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::BodyHeight(double height) {
  if (state_ != State::kBalance && state_ != State::kPosing) return MotionVerdict::kNotNow;
  wanted_.place.z() = figures_.stand_height +
                      std::clamp(height, figures_.height_range[0], figures_.height_range[1]);
  stance_.Follow(stance_.Feasible(wanted_));
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::StopMove() {
  if (state_ == State::kGesture && frame_ + kKeyframesBack < frames_.size()) {
    Play(frames_.size() - kKeyframesBack);
  } else if (state_ == State::kBalance || state_ == State::kPosing) {
    return Pose(false);
  }
  return MotionVerdict::kTaken;
}

MotionVerdict QuadrupedMotion::Move() const {
  switch (state_) {
    case State::kRising:
    case State::kLocked:
      return MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      return MotionVerdict::kUnable;
    default:
      return MotionVerdict::kNotNow;
  }
}

// error_code and mode of the vendor's sport service page. Recovering is in neither list: the crouch
// and recoveryStand of the older firmware are assumed.
MotionState QuadrupedMotion::state() const {
  MotionState state;
  const auto is = [&state](int id, int mode, int progress) {
    state.id = id;
    state.mode = mode;
    state.progress = progress;
  };
  switch (state_) {
    case State::kDamped:
      is(1001, 7, 0);
      break;
    case State::kFolding:
    case State::kRising:
    case State::kLocked:
      is(1002, 6, 0);
      break;
    case State::kLowering:
    case State::kUnfolding:
    case State::kLying:
      is(1004, 5, 0);
      break;
    case State::kBalance:
      is(1013, 1, 0);
      break;
    case State::kGesture:
      is(1006, 1, 1);
      break;
    case State::kSittingDown:
    case State::kSitting:
      is(1007, 10, 0);
      break;
    case State::kPosing:
      is(1091, 2, 0);
      break;
    case State::kRecovering:
      is(2006, 8, 0);
      break;
  }
  state.body_height = balances() ? stance_.measured().place.z() : body_.Height(reading_);
  return state;
}

StancePose QuadrupedMotion::Default() const {
  return {.place = {0, 0, figures_.stand_height}, .rpy = {0, 0, 0}};
}

StancePose QuadrupedMotion::InMetres(const StancePose& posture) const {
  StancePose pose = posture;
  pose.place *= body_.leg_length();
  pose.place.z() += figures_.stand_height;
  pose.paw *= body_.leg_length();
  return pose;
}

bool QuadrupedMotion::upright() const { return reading_.up.z() > kUprightCosine; }

void QuadrupedMotion::Balance() {
  stance_.Begin(reading_);
  wanted_ = Default();
  stance_.MoveTo(stance_.Feasible(wanted_), kReturnTime);
  for (std::size_t leg = 0; leg < wheel_angles_.size(); ++leg) wheel_angles_[leg] = kNoPosition;
  state_ = State::kBalance;
}

void QuadrupedMotion::Play(std::size_t frame) {
  frame_ = frame;
  state_ = State::kGesture;
  if (frame < frames_.size()) {
    stance_.MoveTo(stance_.Feasible(InMetres(frames_[frame].pose)), frames_[frame].duration);
  } else {
    wanted_ = Default();
    stance_.MoveTo(stance_.Feasible(wanted_), kReturnTime);
  }
}

std::unique_ptr<Motion> MakeQuadrupedMotion(const RobotSpec& spec, const PhysicsWorld& world) {
  return std::make_unique<QuadrupedMotion>(spec, ReadQuadruped(world, spec));
}

}  // namespace understudy
