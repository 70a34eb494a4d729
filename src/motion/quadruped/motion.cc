#include "motion/quadruped/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "motion/quadruped/capture.h"
#include "motion/quadruped/goal_facts.h"
#include "motion/rotations.h"
#include "robot/firmware.h"

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
constexpr double kSharpest = 0.25;       // rad/m, of the bends that wheels roll through
constexpr double kStepsOn = 2.0;         // s it steps on where it could roll
constexpr double kFallenRest = 1.0;      // s a fallen robot lies before it gets up by itself
constexpr double kLyingRest = 5.0;    // s from lying down to damping: "after some seconds" on a B2
constexpr double kLeastRaise = 0.01;  // m a foot is lifted by, however low it is to be
constexpr double kLed = 1.2;          // s in which a stand has followed to where it was led

// Before it told its state's id a Go2 trotted; what robots do that never told it is a B2's word.
authority::goal::GaitName DefaultGait(const robot::RobotSpec& spec) {
  const bool before_ids = !spec.state_id_since.empty() && !robot::TellsStateId(spec);
  return before_ids ? authority::goal::GaitName::kTrot : authority::goal::GaitName::kFree;
}

}  // namespace

QuadrupedMotion::QuadrupedMotion(const robot::RobotSpec& spec, const QuadrupedFigures& figures,
                                 std::unique_ptr<PolicyDrive> policy)
    : spec_(spec),
      figures_(spec.motion.quadruped),
      body_(figures),
      estimator_(body_),
      feet_(body_),
      stance_(body_),
      gesture_(&stance_, body_.leg_length(), figures_.stand_height),
      recovery_(body_),
      trot_(body_, estimator_, figures_),
      drive_(body_, estimator_, &stance_, figures_),
      wheels_(figures_),
      asked_(!wheeled()) {
  if (policy) policy_.emplace(std::move(policy));
  Use(RowOf(DefaultGait(spec)), 0);
}

void QuadrupedMotion::Start(const authority::MotionInput& input) {
  reading_ = body_.Read(input);
  estimator_.Begin(reading_);
  foot_raise_ = 0;
  Use(RowOf(DefaultGait(spec_)), 0);
  stepping_ = false;
  asked_.Last(false);
  wanted_ = Default();
  Enter(kDamped);
  if (!upright()) return;
  if (estimator_.height() > kExtended * figures_.stand_height) {
    Enter(kStanding);
  } else if (figures_.stands_up) {
    Enter(kFoldingOn);
  }
}

void QuadrupedMotion::Use(const GaitRow& gait, int level) {
  gait_ = &gait;
  level_ = level;
  figures_.walk = WalkIn(gait, level, spec_.motion.quadruped.walk);
  figures_.walk.foot_raise = std::max(figures_.walk.foot_raise + foot_raise_, kLeastRaise);
}

authority::MotionVerdict QuadrupedMotion::Ask(const authority::MotionGoal& goal) {
  const auto rows = QuadrupedTransitions();
  const bool known = std::ranges::count(rows, goal.index(), &QuadrupedTransition::wish) > 0;
  if (!known || !IsSound(goal)) return authority::MotionVerdict::kUnknown;
  const auto holds = [this](QuadrupedWhen when) { return Holds(when); };
  const QuadrupedTransition* row = Find(rows, goal.index(), state_, holds);
  if (row == nullptr && kMovingStates.Has(state_)) {
    // What a stand leads to is done once it has stopped.
    row = Find(rows, goal.index(), kStanding, holds);
    if (row != nullptr && row->verdict == authority::MotionVerdict::kTaken) {
      then_ = goal;
      asked_.End();
      return row->verdict;
    }
  }
  // That it has fallen is no news while it recovers.
  const bool waits = !IsMove(goal) && !std::holds_alternative<goal::Fall>(goal);
  if (row == nullptr && kOnTheWay.Has(state_) && waits) {
    // What the posture that it is on the way to allows is done there.
    row = Find(rows, goal.index(), EndOf(state_), holds);
    const bool from_lock =
        figures_.gestures_from_lock && EndOf(state_) == kLocked && IsGesture(goal);
    if (from_lock || (row != nullptr && row->verdict == authority::MotionVerdict::kTaken)) {
      then_ = goal;
      return authority::MotionVerdict::kTaken;
    }
  }
  const bool rises = kSits.Has(state_) && std::holds_alternative<goal::StandUp>(goal);
  if (row == nullptr && figures_.gestures_from_lock &&
      (rises || (state_ == kLocked && IsGesture(goal)))) {
    Enter(rises ? kRisingSit : stand_ = kBalance);
    then_ = goal;
    return authority::MotionVerdict::kTaken;
  }
  if (row == nullptr) return authority::MotionVerdict::kNotNow;
  if (row->verdict == authority::MotionVerdict::kTaken) {
    // A new way up or down replaces what was to follow the old one.
    if (row->to || std::holds_alternative<goal::StandUp>(goal)) then_.reset();
    if (const auto* gesture = std::get_if<goal::Gesture>(&goal)) gesture_name_ = gesture->name;
    if (std::holds_alternative<goal::BalanceStand>(goal)) stand_ = kBalance;
    if (std::holds_alternative<goal::Gait>(goal) ||
        std::holds_alternative<goal::RecoveryStand>(goal)) {
      stand_ = kStanding;
    }
    if (row->to) Enter(*row->to == kStanding ? stand_ : *row->to);
    if (std::holds_alternative<goal::Fall>(goal)) fallen_ = true;
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
  const bool topples = Topples();
  const Vector3d rolling = reading_.R_TB * (reading_.R_WB.transpose() * Rolling());
  const State from = std::exchange(state_, state);
  since_ = 0;
  fallen_ = false;
  if (!kStands.Has(state) && !kMovingStates.Has(state)) asked_.End();
  switch (state) {
    case kDamped:
      stand_ = kStanding;
      then_.reset();
      now_ = nullptr;
      break;
    case kLocked:
    case kLying:
      now_ = nullptr;
      break;
    case kFolding:
    case kFoldingOn:
      if (from == kFolding || from == kFoldingOn) break;  // the move goes on, to another end
      joints_.Begin(reading_, body_.Angles(Under(kCrouch * body_.leg_length())));
      now_ = &joints_;
      break;
    case kRising:
    case kRisingOn:
      if (state == kRising) stand_ = kStanding;
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
    case kStanding:
    case kBalance:
      Stand(from);
      break;
    case kGesturing:
    case kRisingSit:
      wanted_ = Default();
      gesture_.Begin(state == kGesturing ? KeyframesOf(gesture_name_)
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
      SetPose(InMetres(PosePosture(), body_.leg_length(), figures_.stand_height));
      break;
    case kRecovering:
      recovery_.Begin(reading_);
      now_ = &recovery_;
      break;
    case kWalking:
      if (!topples) stand_ = kStanding;
      rolls_for_ = 0;
      wheels_.LetGo();
      if (policy_) {
        policy_->Begin();
        now_ = &*policy_;
        break;
      }
      if (const PerLeg rest = Under(figures_.stand_height - body_.radius()); topples) {
        trot_.BeginToppling(reading_, rest, rolling);
      } else {
        trot_.Begin(reading_, rest);
      }
      trot_.Carry(wanted_.place.z(), wanted_.rpy);
      now_ = &trot_;
      break;
    case kDriving:
      stand_ = kStanding;
      drive_.Begin();
      now_ = &drive_;
      break;
  }
}

Vector3d QuadrupedMotion::Rolling() const {
  return state_ == kDriving ? RollingVelocity(reading_) : Vector3d(0, 0, 0);
}

bool QuadrupedMotion::Topples() const {
  const bool at_rest = kStands.Has(state_) && led_ > kLed;
  return (at_rest || state_ == kDriving) &&
         MustStep(reading_, estimator_.v_WB_W() - Rolling(),
                  std::sqrt(body_.gravity() / figures_.stand_height));
}

// Wheels roll ahead and through wide bends. What goes sideways or turns on the spot, where tyres
// would have to slip, is stepped with the wheels braked, and what follows for a while: to change
// between the two it has to stop.
void QuadrupedMotion::Move(const authority::MotionInput& input, double dt) {
  const Vector3d asked = asked_.Step(dt, Here(), input.obstacles);
  const Vector3d taken = policy_ ? asked : trot_.Taken(asked);
  const bool stepping = stepping_ && !then_;
  const bool rolls = wheeled() && !stepping && std::abs(taken.y()) <= figures_.walk.dead_band.y() &&
                     std::abs(taken.z()) <= kSharpest * std::abs(taken.x());
  rolls_for_ = rolls ? rolls_for_ + dt : 0;
  const bool steps = !rolls || (state_ == kWalking && rolls_for_ < kStepsOn);
  if (policy_) {
    policy_->KeepStepping(stepping);
    policy_->Ask(taken);
  }
  trot_.KeepStepping(stepping);
  trot_.Ask(steps ? taken : Vector3d::Zero());
  trot_.Hurry(!steps && !taken.isZero(0));
  drive_.Ask(steps ? Vector3d::Zero() : taken);
  if (state_ == kWalking && !taken.isZero(0)) stand_ = kStanding;
  if (Topples()) {
    Enter(kWalking);
  } else if (kStands.Has(state_) && (stance_.over() || !steps) && (stepping || !taken.isZero(0))) {
    Enter(steps ? kWalking : kDriving);
  }
}

void QuadrupedMotion::Stand(State from) {
  now_ = &stance_;
  if (kGestureStates.Has(from) || from == kDriving) return;
  if (kStanceStates.Has(from)) return SetPose(Default());
  stance_.Begin(reading_);
  if (from != kWalking) wanted_ = Default();
  stance_.MoveTo(stance_.Feasible(wanted_), kBalanceTime);
  wheels_.LetGo();
}

void QuadrupedMotion::Keep(const authority::MotionGoal& goal) {
  if (const auto* recovery = std::get_if<goal::AutoRecovery>(&goal)) auto_recovery_ = recovery->on;
  if (const auto* gait = std::get_if<goal::Gait>(&goal)) {
    const bool back = gait->name == goal::GaitName::kFree;  // to the default one
    Use(RowOf(back ? DefaultGait(spec_) : gait->name), level_);
  }
  if (const auto* speed = std::get_if<goal::SpeedLevel>(&goal)) Use(*gait_, speed->level);
  if (const auto* raise = std::get_if<goal::FootRaise>(&goal)) {
    foot_raise_ = raise->over;
    Use(*gait_, level_);
  }
  if (const auto* stepping = std::get_if<goal::KeepStepping>(&goal)) stepping_ = stepping->on;
  if (const auto* lasting = std::get_if<goal::LastingMoves>(&goal)) asked_.Last(lasting->on);
  if (std::holds_alternative<goal::ResetEstimator>(goal)) estimator_.Begin(reading_);
  if (std::holds_alternative<goal::StopMove>(goal)) {
    stepping_ = false;
    asked_.End();
  }
  const bool moves = kStands.Has(state_) || kMovingStates.Has(state_);
  if (moves && asked_.Take(goal, ScaleOf(level_).sticks, Here())) then_.reset();
  if (const auto pose = PoseOf(goal, wanted_, figures_, body_.leg_length())) SetPose(*pose);
}

void QuadrupedMotion::SetPose(const StancePose& pose) {
  wanted_ = pose;
  led_ = 0;
  if (state_ == kWalking) {
    trot_.Carry(wanted_.place.z(), wanted_.rpy);
  } else {
    stance_.Follow(stance_.Feasible(wanted_));
  }
}

robot::MotionState QuadrupedMotion::state() const {
  const QuadrupedStateRow& row = RowOf(state_);
  const bool moves = kMovingStates.Has(state_);
  robot::MotionState state{.id = moves || state_ == kStanding ? gait_->id : row.id,
                           .name = row.name,
                           .mode = moves                 ? gait_->moving
                                   : kStands.Has(state_) ? gait_->standing
                                                         : row.mode,
                           .progress = row.progress,
                           .body_height = estimator_.height(),
                           .estimates = true,
                           .v_WB_W = estimator_.v_WB_W(),
                           .p_WB = estimator_.p_WB(),
                           .gait = gait_->type,
                           .wanted_height = wanted_.place.z(),
                           .foot_raise = figures_.walk.foot_raise,
                           .keeps_stepping = stepping_,
                           .avoids = asked_.avoids()};
  for (std::size_t leg = 0; leg < state.feet.size(); ++leg) {
    state.feet[leg] = reading_.feet[leg];
    state.feet_speed[leg] = reading_.feet_speed[leg];
  }
  return state;
}

void QuadrupedMotion::Step(const authority::MotionInput& input, double dt,
                           robot::RobotCommand* command) {
  reading_ = body_.Read(input);
  estimator_.Step(reading_, dt, now_ == &trot_ ? trot_.stands() : std::array<double, 4>{1, 1, 1, 1},
                  state_ == kDamped || state_ == kLying);
  since_ += dt;
  led_ += dt;
  if (state_ == kDamped && fallen_ && auto_recovery_ && since_ > kFallenRest) Enter(kRecovering);
  if (state_ == kLying && since_ > kLyingRest) Enter(kDamped);
  if (policy_) policy_->Sense(input);
  Move(input, dt);
  if (now_ != nullptr) now_->Step(reading_, dt, &legs_);
  if (state_ == kDamped) {
    Brake(figures_.damping_kd, command);
  } else if (state_ == kLying && wheeled()) {
    Brake(0, command);  // the vendor's Go2-W page: motors idle after StandDown
  } else if (policy_ && now_ == &*policy_) {
    std::ranges::copy(policy_->command().motors, command->motors.begin());
  } else {
    CommandLegs(legs_, figures_.kp, figures_.kd, command);
    Wheels(input, command);
  }
  const State next = RowOf(state_).next;
  if (next != state_ && now_->over()) Enter(next == kStanding ? stand_ : next);
  if ((kStands.Has(state_) || state_ == kLocked || state_ == kSitting) && then_) {
    Ask(*std::exchange(then_, std::nullopt));
  }
}

void QuadrupedMotion::Wheels(const authority::MotionInput& input, robot::RobotCommand* command) {
  for (std::size_t i = 12; i < command->motors.size(); ++i) {
    const std::size_t leg = i - 12;
    robot::MotorCommand& wheel = command->motors[i];
    const bool stays = kStanceStates.Has(state_) || state_ == kWalking;
    if (leg >= legs_.q.size() || !stays) {
      wheel = wheels_.Free();
    } else if (state_ == kDriving) {
      const double carried = stance_.held_rate().y() + legs_.dq[leg][1] + legs_.dq[leg][2];
      wheel = wheels_.Run(leg, drive_.rates()[leg] - carried);
    } else {
      // That of a leg that steps keeps its place on the calf.
      const double carried =
          state_ == kWalking ? 0 : stance_.held().rpy.y() + legs_.q[leg][1] + legs_.q[leg][2];
      wheel = wheels_.Stay(leg, input.motors[i].q, carried);
    }
  }
}

Vector3d QuadrupedMotion::Here() const {
  const Vector3d& p = estimator_.p_WB();
  return {p.x(), p.y(), RollPitchYaw(reading_.R_WB).z()};
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

}  // namespace understudy::motion
