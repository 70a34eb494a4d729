#include "motion/quadruped/motion.h"

#include <algorithm>
#include <cmath>

namespace understudy::motion {
namespace {

using Eigen::Vector3d;

// All assumed.
constexpr double kUprightCosine = 0.85;  // from which the legs alone can lift or lower the robot
constexpr double kExtended = 0.6;        // of the standing height: higher is standing
constexpr double kReturnTime = 1.0;      // s back to a balanced stand
constexpr double kSitTime = 1.8;         // s

}  // namespace

QuadrupedMotion::QuadrupedMotion(const robot::RobotSpec& spec, const QuadrupedFigures& figures)
    : spec_(spec),
      figures_(spec.motion.quadruped),
      body_(figures),
      estimator_(body_),
      stance_(body_),
      recovery_(body_),
      joints_(12) {}

void QuadrupedMotion::Start(const authority::MotionInput& input) {
  reading_ = body_.Read(input);
  estimator_.Begin(reading_);
  state_ = State::kDamped;
  balance_next_ = false;
  fallen_for_ = 0;
  if (upright() && estimator_.height() > kExtended * figures_.stand_height) Balance();
}

authority::MotionVerdict QuadrupedMotion::Ask(const authority::MotionGoal& goal) {
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::all_of(goal.value.begin(), goal.value.end(), finite))
    return authority::MotionVerdict::kUnknown;
  switch (goal.action) {
    case authority::MotionAction::kDamp:
      state_ = State::kDamped;
      fallen_for_ = 0;
      return authority::MotionVerdict::kTaken;
    case authority::MotionAction::kAutoRecovery:
      auto_recovery_ = goal.value[0] != 0;
      return authority::MotionVerdict::kTaken;
    case authority::MotionAction::kStandUp:
      return StandUp();
    case authority::MotionAction::kStandDown:
      return StandDown();
    case authority::MotionAction::kBalanceStand:
      return BalanceStand();
    case authority::MotionAction::kRecoveryStand:
      return Recover();
    case authority::MotionAction::kSit:
      return Sit();
    case authority::MotionAction::kRiseSit:
      return RiseSit();
    case authority::MotionAction::kHello:
      return Gesture(HelloKeyframes());
    case authority::MotionAction::kStretch:
      return Gesture(StretchKeyframes());
    case authority::MotionAction::kPose:
      return Pose(goal.value[0] != 0);
    case authority::MotionAction::kEuler:
      return Euler({goal.value[0], goal.value[1], goal.value[2]});
    case authority::MotionAction::kBodyHeight:
      return BodyHeight(goal.value[0]);
    case authority::MotionAction::kStopMove:
      return StopMove();
    case authority::MotionAction::kMove:
      return Move();
    default:
      return authority::MotionVerdict::kUnknown;
  }
}

authority::MotionVerdict QuadrupedMotion::StandUp() {
  switch (state_) {
    case State::kDamped:
    case State::kUnfolding:
    case State::kLying:
      if (!upright()) return authority::MotionVerdict::kNotNow;
      balance_next_ = false;
      Fold();
      return authority::MotionVerdict::kTaken;
    case State::kLowering:
      balance_next_ = false;
      Rise(Stand());
      return authority::MotionVerdict::kTaken;
    case State::kFolding:
    case State::kRising:
    case State::kLocked:
      balance_next_ = false;
      return authority::MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      balance_next_ = false;
      Rise(stance_.FeetInBase(Default()));  // the feet stay where they are
      return authority::MotionVerdict::kTaken;
    default:
      return authority::MotionVerdict::kNotNow;
  }
}

authority::MotionVerdict QuadrupedMotion::StandDown() {
  switch (state_) {
    case State::kDamped:
      if (!upright()) return authority::MotionVerdict::kNotNow;
      Unfold();
      return authority::MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      if (wheeled()) return authority::MotionVerdict::kNotNow;
      Lower();
      return authority::MotionVerdict::kTaken;
    case State::kLocked:
      Lower();
      return authority::MotionVerdict::kTaken;
    case State::kLowering:
    case State::kUnfolding:
    case State::kLying:
      return authority::MotionVerdict::kTaken;
    default:
      return authority::MotionVerdict::kNotNow;
  }
}

authority::MotionVerdict QuadrupedMotion::BalanceStand() {
  switch (state_) {
    case State::kRising:
      balance_next_ = true;
      return authority::MotionVerdict::kTaken;
    case State::kLocked:
      Balance();
      return authority::MotionVerdict::kTaken;
    case State::kPosing:
      return Pose(false);
    case State::kBalance:
      return authority::MotionVerdict::kTaken;
    default:
      return authority::MotionVerdict::kNotNow;
  }
}

authority::MotionVerdict QuadrupedMotion::Recover() {
  switch (state_) {
    case State::kRecovering:
      return authority::MotionVerdict::kTaken;
    case State::kDamped:
    case State::kFolding:
    case State::kLowering:
    case State::kUnfolding:
    case State::kLying:
      state_ = State::kRecovering;
      recovery_.Begin(reading_);
      return authority::MotionVerdict::kTaken;
    case State::kSittingDown:
    case State::kSitting:
      return wheeled() ? authority::MotionVerdict::kNotNow : RiseSit();
    default:
      return wheeled() ? authority::MotionVerdict::kNotNow : BalanceStand();
  }
}

authority::MotionVerdict QuadrupedMotion::Sit() {
  if (state_ == State::kSitting) return authority::MotionVerdict::kTaken;
  if (state_ != State::kBalance) return authority::MotionVerdict::kNotNow;
  StancePose pose = Default();
  pose.place += Vector3d(figures_.sit[0], 0, figures_.sit[1]);
  pose.rpy.y() = figures_.sit[2];
  stance_.MoveTo(stance_.Feasible(pose), kSitTime);
  state_ = State::kSittingDown;
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::RiseSit() {
  if (state_ != State::kSitting) return authority::MotionVerdict::kNotNow;
  frames_ = {};
  Play(0);
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::Gesture(std::span<const Keyframe> frames) {
  if (state_ != State::kBalance) return authority::MotionVerdict::kNotNow;
  frames_ = frames;
  Play(0);
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::Pose(bool on) {
  if (state_ != State::kBalance && state_ != State::kPosing)
    return authority::MotionVerdict::kNotNow;
  wanted_ = on ? InMetres(PosePosture()) : Default();
  stance_.Follow(stance_.Feasible(wanted_));
  state_ = on ? State::kPosing : State::kBalance;
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::Euler(const Vector3d& rpy) {
  if (state_ != State::kBalance && state_ != State::kPosing)
    return authority::MotionVerdict::kNotNow;
  for (int i = 0; i < 3; ++i) {
    const double most = figures_.euler_range[i];
    wanted_.rpy[i] = std::clamp(rpy[i], -most, most);
  }
  stance_.Follow(stance_.Feasible(wanted_));
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::BodyHeight(double height) {
  if (state_ != State::kBalance && state_ != State::kPosing)
    return authority::MotionVerdict::kNotNow;
  wanted_.place.z() = figures_.stand_height +
                      std::clamp(height, figures_.height_range[0], figures_.height_range[1]);
  stance_.Follow(stance_.Feasible(wanted_));
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::StopMove() {
  if (state_ == State::kGesture && frame_ + kKeyframesBack < frames_.size()) {
    Play(frames_.size() - kKeyframesBack);
  } else if (state_ == State::kBalance || state_ == State::kPosing) {
    return Pose(false);
  }
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict QuadrupedMotion::Move() const {
  switch (state_) {
    case State::kRising:
    case State::kLocked:
      return authority::MotionVerdict::kTaken;
    case State::kBalance:
    case State::kPosing:
      return authority::MotionVerdict::kUnable;
    default:
      return authority::MotionVerdict::kNotNow;
  }
}

// error_code and mode of the vendor's sport service page. Recovering is in neither list: the crouch
// and recoveryStand of the older firmware are assumed.
robot::MotionState QuadrupedMotion::state() const {
  robot::MotionState state;
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
  state.body_height = estimator_.height();
  state.v_WB_W = estimator_.v_WB_W();
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
  for (std::size_t leg = 0; leg < wheel_angles_.size(); ++leg)
    wheel_angles_[leg] = robot::kNoPosition;
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

std::unique_ptr<authority::Motion> MakeQuadrupedMotion(const robot::RobotSpec& spec,
                                                       const physics::PhysicsWorld& world) {
  return std::make_unique<QuadrupedMotion>(spec, ReadQuadruped(world, spec));
}

}  // namespace understudy::motion
