#include "motion/humanoid/motion.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/overloaded.h"

namespace understudy::motion {
namespace {

constexpr double kMoveTime = 4;  // s: on hardware within 5 s (docs/dev/sources.md#g1-states)
// From the request to squat balanced to damping, a G1's (docs/dev/sources.md#g1-states).
constexpr double kSquatLasts = 9;  // s

// Assumed, tried on every robot here.
constexpr double kSettleTime = 1;    // s, into the standing pose of a robot found standing
constexpr double kFoundTilt = 0.3;   // rad, at most, of a robot that stands
constexpr double kFoundPose = 0.25;  // rad, at most, off its standing pose
constexpr double kNoLoad = 0.1;      // of its weight: feet with less carry nothing
constexpr double kAloft = 0.3;       // s, without load: it has been lifted off the ground

// The states of a robot without a policy: those that it would walk in are balanced or unplayed.
robot::HumanoidMotionSpec WithoutWalk(robot::HumanoidMotionSpec ids) {
  ids.unplayed.insert(ids.unplayed.end(), ids.walk.begin(), ids.walk.end());
  ids.walk.clear();
  return ids;
}

}  // namespace

HumanoidMotion::HumanoidMotion(const robot::RobotSpec& spec, const physics::RobotBody& body,
                               std::unique_ptr<PolicyDrive> policy)
    : spec_(spec),
      ids_(policy ? spec.motion.humanoid : WithoutWalk(spec.motion.humanoid)),
      senses_(body.nominal(), body.spec()),
      gains_(FindGains(spec, senses_.body())),
      bearing_(spec.motors.size()),
      slack_(gains_, &bearing_),
      posture_(gains_, &bearing_),
      stand_(spec, gains_, senses_.body(), &bearing_),
      walk_(body.nominal(), body.spec(), gains_, senses_.body(), &stand_.arms()) {
  if (policy) policy_.emplace(std::move(policy));
}

void HumanoidMotion::Start(const authority::MotionInput& input) {
  senses_.Begin(input);
  Slacken(robot::kZeroTorqueId);
  const bool can_lock = StanceOf(ids_, ids_.lock_stand) == HumanoidStance::kLockStand;
  if (can_lock && IsInStandingPose()) Lock(ids_.lock_stand, spec_.standing.q, kSettleTime);
}

bool HumanoidMotion::IsInStandingPose() const {
  const HumanoidReading& sensed = senses_.reading();
  double off = 0;
  for (std::size_t i = 0; i < sensed.q.size(); ++i) {
    if (gains_.bears[i]) off = std::max(off, std::abs(sensed.q[i] - spec_.standing.q[i]));
  }
  return off <= kFoundPose && sensed.body.attitude()(2, 2) > std::cos(kFoundTilt);
}

authority::MotionVerdict HumanoidMotion::Ask(const authority::MotionGoal& goal) {
  using authority::MotionVerdict;
  namespace goal_of = authority::goal;
  const auto when_balanced = [this](MotionVerdict verdict) {
    return balanced() || driven() ? verdict : MotionVerdict::kNotNow;
  };
  return std::visit(
      Overloaded{
          [&](goal_of::ZeroTorque) { return SetFsm(robot::kZeroTorqueId); },
          [&](goal_of::Damp) { return SetFsm(robot::kDampingId); },
          [&](goal_of::Fall) {
            if (!balanced() && !driven()) return MotionVerdict::kNotNow;
            Slacken(robot::kDampingId);
            return MotionVerdict::kTaken;
          },
          [&](goal_of::StandUp) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::RiseSit) { return SetFsm(ids_.lock_stand); },
          [&](goal_of::StandDown) { return SetFsm(ids_.squat); },
          [&](goal_of::Sit) { return SetFsm(ids_.sit); },
          [&](goal_of::BalanceStand) {
            return SetFsm(ids_.balance.empty() ? -1 : static_cast<int>(ids_.balance.front()));
          },
          [&](const goal_of::SetFsm& fsm) { return SetFsm(fsm.id); },
          [&](goal_of::StopMove) {
            if (driven()) policy_->Ask({0, 0, 0}, 0);
            walk_.Ask({0, 0, 0}, 0);
            return when_balanced(MotionVerdict::kTaken);
          },
          [&](const goal_of::Move& move) { return Move(move); },
          [&](const goal_of::SetBalanceMode& balance) { return SetBalanceMode(balance.mode); },
          [&](const goal_of::SetStandHeight& stand) { return SetStandHeight(stand.height); },
          [&](const goal_of::ArmAction& action) { return BeginArmAction(action.id); },
          [&](goal_of::StopArmAction) {
            stand_.arms().Release();
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
  if (id == id_ && id != ids_.balanced_squat) return verdict;
  // States that bear load.
  if (id == robot::kZeroTorqueId && id_ != robot::kDampingId)
    return authority::MotionVerdict::kIgnored;
  if (id == robot::kZeroTorqueId || id == robot::kDampingId) {
    Slacken(id);
  } else if (id == ids_.lock_stand) {
    Lock(id, spec_.standing.q, kMoveTime);
  } else if (id == ids_.squat || id == ids_.sit) {
    Lock(id, id == ids_.squat ? ids_.squat_q : ids_.sit_q, kMoveTime);
  } else if (StanceOf(ids_, id) == HumanoidStance::kWalking) {
    Drive(id);
  } else {
    Balance(id);
  }
  return verdict;
}

void HumanoidMotion::Slacken(int id) {
  walk_.Forget();
  stand_.arms().Reset();
  slack_.Begin(/*limp=*/id == robot::kZeroTorqueId);
  now_ = &slack_;
  id_ = id;
}

void HumanoidMotion::Lock(int id, std::span<const double> q, double duration) {
  walk_.Forget();
  stand_.arms().Reset();
  posture_.Begin(senses_.reading(), q, duration);
  now_ = &posture_;
  id_ = id;
}

void HumanoidMotion::Balance(int id) {
  if (id == ids_.balanced_squat) {
    walk_.Ask({0, 0, 0}, 0);
    stand_.Squat(/*down=*/id_ != id);
    down_for_ = 0;
  } else {
    if (!balanced()) stand_.Begin(senses_.reading());
    stood_in_ = id;
  }
  now_ = &stand_;
  id_ = id;
}

void HumanoidMotion::Drive(int id) {
  stand_.arms().Reset();
  if (!driven()) policy_->Begin(senses_.reading());
  now_ = &*policy_;
  id_ = id;
}

bool HumanoidMotion::may_step() const {
  return walk_.possible() && id_ != ids_.balanced_squat && id_ != ids_.arms_balance &&
         stand_.over() && !unloaded();
}

authority::MotionVerdict HumanoidMotion::Move(const authority::goal::Move& move) {
  using authority::MotionVerdict;
  if (!balanced() && !driven()) return MotionVerdict::kNotNow;
  if (!driven() && !walk_.possible()) return MotionVerdict::kUnable;
  const Eigen::Vector3d velocity(move.vx, move.vy, move.yaw_rate);
  if (!velocity.allFinite()) return MotionVerdict::kUnknown;
  if (driven()) {
    policy_->Ask(velocity, move.hold);
  } else if (may_step()) {
    walk_.Ask(velocity, move.hold);
  } else {
    return MotionVerdict::kNotNow;
  }
  return MotionVerdict::kTaken;
}

authority::MotionVerdict HumanoidMotion::SetBalanceMode(int mode) {
  using authority::MotionVerdict;
  if (!balanced() && !driven()) return MotionVerdict::kNotNow;
  const bool steps = balanced() && walk_.possible();
  if (mode != 0 && (mode != 1 || !steps)) return MotionVerdict::kUnable;
  walk_.KeepStepping(mode == 1);
  return MotionVerdict::kTaken;
}

authority::MotionVerdict HumanoidMotion::SetStandHeight(double height) {
  if (!std::isfinite(height)) return authority::MotionVerdict::kUnknown;
  if (!balanced()) return authority::MotionVerdict::kNotNow;
  if (ids_.squat_q.empty()) return authority::MotionVerdict::kUnable;
  if (moving() || id_ == ids_.balanced_squat) return authority::MotionVerdict::kNotNow;
  if (!ids_.stand_heights) return authority::MotionVerdict::kIgnored;
  stand_.StandAt(height);
  return authority::MotionVerdict::kTaken;
}

authority::MotionVerdict HumanoidMotion::BeginArmAction(int id) {
  if (!ids_.arm_actions) return authority::MotionVerdict::kUnknown;
  const bool allowed = balanced() && id_ != ids_.balanced_squat;
  // An unknown id is reported before a state that does not allow it.
  if (!allowed && id != kReleaseArms && FindArmSequence(id) == nullptr &&
      !IsUnplayedArmAction(id)) {
    return authority::MotionVerdict::kUnknown;
  }
  return allowed ? stand_.arms().Begin(id) : authority::MotionVerdict::kNotNow;
}

robot::MotionState HumanoidMotion::state() const {
  const ArmActionPlayer& arms = stand_.arms();
  return {.id = id_,
          .name = Name(StanceOf(ids_, id_)),
          .mode = moving() || id_ == ids_.balanced_squat ? 1
                  : unloaded()                           ? 2
                                                         : 0,
          .progress = (moving() && !walking()) || (arms.id() != 0 && !arms.holding()) ? 1 : 0,
          .arm_action = arms.id(),
          .arm_told = arms.told(),
          .arm_holding = arms.holding(),
          .body_height = senses_.reading().body.base().z(),
          .v_WB_W = walking() ? walk_.velocity() : senses_.reading().body.base_velocity()};
}

void HumanoidMotion::Step(const authority::MotionInput& input, double dt,
                          robot::RobotCommand* command) {
  senses_.Step(input, dt);
  StepOrStand(dt);
  now_->Step(senses_.reading(), dt, command);
  if (id_ == ids_.balanced_squat) {
    down_for_ += dt;
    if (stand_.upright()) {
      id_ = stood_in_;
    } else if (stand_.squats() && down_for_ >= kSquatLasts) {
      Slacken(robot::kDampingId);
    }
  }
  FollowArms(input.arm_weight);
}

void HumanoidMotion::StepOrStand(double dt) {
  const HumanoidReading& sensed = senses_.reading();
  aloft_ = walking() && unloaded() ? aloft_ + dt : 0;
  if (walking() && (walk_.over() || aloft_ > kAloft)) {
    walk_.Forget();
    stand_.Begin(sensed, /*walked=*/true);
    now_ = &stand_;
  } else if (now_ == &stand_ && may_step() && (walk_.wanted() || walk_.Topples(sensed))) {
    walk_.Begin(sensed);
    now_ = &walk_;
  }
}

// rt/arm_sdk has a state of its own where the robot has one, in which it does not walk.
void HumanoidMotion::FollowArms(double weight) {
  if (!balanced() || ids_.arms_balance < 0 || ids_.balance.empty()) return;
  const int usual = ids_.balance.front();
  if (id_ == usual && weight > 0) {
    id_ = ids_.arms_balance;
    walk_.Forget();
  } else if (id_ == ids_.arms_balance && weight <= 0) {
    id_ = usual;
  }
}

bool HumanoidMotion::unloaded() const {
  return kBearingStances.Has(StanceOf(ids_, id_)) && senses_.reading().load < kNoLoad;
}

}  // namespace understudy::motion
